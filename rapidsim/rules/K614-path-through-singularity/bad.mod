MODULE example
  VAR robtarget below;
  PROC main()
    MoveAbsJ [[0,0,0,0,15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    below:=CalcRobT([[0,10,0,0,-15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    ConfL \Off;
    MoveL below,v200,fine,tool0; ! found
  ENDPROC
ENDMODULE
