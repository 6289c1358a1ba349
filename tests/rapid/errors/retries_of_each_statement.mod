! RAPID Overview, Error recovery: the retries of one statement are not those of the next.
MODULE retries_of_each_statement
  VAR num zero;
  VAR num tries;

  PROC main()
    zero:=1/zero;
    tries:=0;
    zero:=2/zero;
    TPWrite "both";                     ! -> both
  ERROR
    Incr tries;
    IF tries=4 THEN
      TPWrite "left "\Num:=RemainingRetries();
      ! -> left 1
      ! -> left 1
      TRYNEXT;
    ENDIF
    RETRY;
  ENDPROC
ENDMODULE
