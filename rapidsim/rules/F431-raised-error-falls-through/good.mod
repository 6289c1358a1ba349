MODULE example
  CONST errnum ERR_NO_PART:=10;
  VAR bool gripped;
  VAR num pieces:=0;
  PROC main()
    pick;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      pieces:=1;
      RETRY;
    ELSE
      RAISE;
    ENDIF
  ENDPROC
  PROC pick()
    WaitTime 1/pieces;
    IF NOT gripped RAISE ERR_NO_PART;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST errnum ERR_NO_PART:=10;
  VAR bool gripped;
  VAR num tries;
  PROC main()
    pick;
  ERROR
    IF ERRNO=ERR_NO_PART THEN
      TPWrite "no part";
    ELSE
      RAISE;
    ENDIF
  ENDPROC
  PROC pick()
    grip;
  ERROR
    IF ERRNO=ERR_NO_PART THEN
      tries:=tries+1;
      RETRY;
    ELSE
      RAISE;
    ENDIF
  ENDPROC
  PROC grip()
    IF NOT gripped RAISE ERR_NO_PART;
  ENDPROC
ENDMODULE
