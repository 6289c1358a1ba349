MODULE example
  VAR bool busy;
  VAR bool ready;
  PROC main()
    IF (NOT busy) AND ready THEN
      WaitTime 1;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR bool busy;
  VAR bool ready;
  PROC main()
    IF NOT (busy AND ready) WaitTime 1;
    IF NOT busy OR ready WaitTime 1;
    IF ready AND NOT busy WaitTime 1;
    IF NOT busy WaitTime 1;
  ENDPROC
ENDMODULE
