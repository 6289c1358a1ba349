! RAPID Instructions, ResetRetryCount: the retries of the statement are counted anew.
MODULE retries_counted_anew
  VAR num zero;
  VAR num tries;

  PROC main()
    zero:=1/zero;
    TPWrite "tries "\Num:=tries;        ! -> tries 7
  ERROR
    Incr tries;
    IF tries=7 TRYNEXT;
    IF tries=3 ResetRetryCount;
    RETRY;
  ENDPROC
ENDMODULE
