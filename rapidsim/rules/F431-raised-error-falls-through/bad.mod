MODULE example
  CONST errnum ERR_NO_PART:=10;
  VAR bool gripped;
  VAR num pieces:=0;
  PROC main()
    pick;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN ! found
      pieces:=1;
      RETRY;
    ENDIF
  ENDPROC
  PROC pick()
    WaitTime 1/pieces;
    IF NOT gripped RAISE ERR_NO_PART;
  ENDPROC
ENDMODULE
