MODULE example
  PROC main()
    AccSet 100,50;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,z50,tool0;
    AccSet 100,100;
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0; ! found
  ENDPROC
ENDMODULE
