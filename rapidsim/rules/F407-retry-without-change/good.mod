MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR parts:=1;
    RETRY;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num tries;
  VAR num parts;
  PROC main()
    WaitTime 1/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      Incr tries;
      IF tries<3 RETRY;
    ENDIF
    parts:=1;
    RETRY;
  ENDPROC
ENDMODULE
