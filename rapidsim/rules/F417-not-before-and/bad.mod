MODULE example
  VAR bool busy;
  VAR bool ready;
  PROC main()
    IF NOT busy AND ready THEN ! found
      WaitTime 1;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR bool busy;
  VAR bool ready;
  VAR signaldi free;
  PROC main()
    WaitUntil NOT busy AND DInput(free)=1\MaxTime:=3;   ! found
    ready:=reg1>3 OR NOT busy AND ready AND reg2>0;     ! found
    IF ready OR (NOT busy AND ready) WaitTime 1;        ! found
  ENDPROC
ENDMODULE
