MODULE example
  CONST jointtarget start:=[[0,0,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;
  PROC main()
    p:=CalcRobT([[0,10,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    MoveAbsJ start,v500,fine,tool0;
    SingArea \LockAxis4;
    ConfL \Off;
    MoveL p,v200,fine,tool0; ! found
  ENDPROC
ENDMODULE
