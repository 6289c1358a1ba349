MODULE example
  CONST jointtarget p:=[[0,0,0,0,30,0],[1500,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ p,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
