MODULE example
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum late;

  PROC main()
    CONNECT late WITH on_late;
    ITimer\Single,0.5,late;
    WaitTime 5;
  ENDPROC

  TRAP on_late
    go_home;
  ENDTRAP

  PROC go_home()
    StopMove;
    StorePath;
    MoveAbsJ home,v1000,fine,tool0;
    RestoPath;
    StartMove;
  ENDPROC
ENDMODULE
! ---
MODULE example
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    RAISE 7;
  ERROR
    MoveAbsJ home,v1000,fine,tool0;
    TRYNEXT;
  ENDPROC
ENDMODULE
