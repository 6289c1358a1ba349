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
    MoveAbsJ home,v1000,fine,tool0; ! found
  ENDPROC
ENDMODULE
