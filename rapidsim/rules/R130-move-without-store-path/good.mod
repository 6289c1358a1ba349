MODULE example
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    RAISE 7;
  ERROR
    StorePath;
    MoveAbsJ home,v1000,fine,tool0;
    RestoPath;
    TRYNEXT;
  ENDPROC
ENDMODULE
! ---
MODULE example
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    try_it;
    MoveAbsJ home,v1000,fine,tool0;
  ENDPROC

  PROC try_it()
    RAISE 7;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
