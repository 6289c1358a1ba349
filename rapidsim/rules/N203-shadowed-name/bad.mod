MODULE example
  PERS num height:=250;
  PROC main()
    VAR num height:=100; ! found
    WaitTime height/1000;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PERS num height:=250;
  LOCAL CONST num width:=3;
  PROC main()
    VAR num Height:=100;      ! found
    WaitTime (height+narrow())/1000;
  ENDPROC
  FUNC num narrow()
    VAR num width;            ! found
    width:=2;
    RETURN width;
  ENDFUNC
  TRAP unused_width
    VAR bool width:=TRUE;     ! found
    IF width TPErase;
  ENDTRAP
ENDMODULE
