MODULE example
  PROC main()
    VAR num parts;
    VAR num part; ! found
    parts:=3;
    WaitTime parts;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST num global_one:=1;    ! found
  LOCAL VAR num of_module;    ! found
  TASK PERS num of_task:=2;   ! found
  PROC main()
    VAR num parts;
    VAR num part;             ! found
    parts:=3;
    WaitTime parts;
    other;
  ENDPROC
  PROC other()
    VAR num parts;            ! found
    VAR bool seen;
    seen:=TRUE;
  ENDPROC
ENDMODULE
