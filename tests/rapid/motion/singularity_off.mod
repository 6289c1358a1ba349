! RAPID Instructions, SingArea: a line through the singularity of the wrist stops the robot.
MODULE singularity_off
  VAR robtarget below;

  PROC main()
    ConfL \Off;
    MoveAbsJ [[0,0,0,0,15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    below:=CalcRobT([[0,10,0,0,-15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    SingArea \Off;
    MoveL below,v200,fine,tool0;
      ! stops: the path to `below` fails at 49 % (57.6 mm): axis 4 would have to jump by 180 deg: the path goes through a singularity
  ENDPROC
ENDMODULE
