MODULE errors_own
  VAR errnum ERR_NO_PART:=-1;
  VAR num retries;
  PROC main()
    BookErrNo ERR_NO_PART;
    Pick;
  ERROR
    IF ERRNO=ERR_NO_PART THEN
      Incr retries;
      IF retries>2 THEN
        ExitCycle;
      ELSE
        RETRY;
      ENDIF
    ENDIF
  ENDPROC
  PROC Pick()
    IF diPart=0 RAISE ERR_NO_PART;
    WaitDI diPart,1\MaxTime:=2;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
