MODULE example
  PROC main()
    MoveAbsJ [[0,0,0,0,30,420],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
