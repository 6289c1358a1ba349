! Field practice, abort: a task without a robot says ClearPath, and the robot goes on.
MODULE robot
  CONST jointtarget j1:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget j2:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ j1,v100,fine,tool0;
    MoveAbsJ j2,v1000\T:=3,fine,tool0;
    TPWrite "there";                                             ! -> there
  ENDPROC
ENDMODULE
