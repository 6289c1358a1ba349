MODULE example
  VAR shapedata table;
  VAR wztemporary guard;
  PROC main()
    WZBoxDef \Inside,table,[600,-500,0],[1500,500,800];
    WZLimSup \Temp,guard,table;
    MoveAbsJ [[0,40,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0; ! found
  ENDPROC
ENDMODULE
