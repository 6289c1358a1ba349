! RAPID Overview, Error recovery: retries that are used up are an error of the caller.
MODULE retries_used_up_in_the_caller
  VAR num zero;
  VAR num tries;

  PROC main()
    insists;
    TPWrite "given up after "\Num:=tries;        ! -> given up after 5
  ERROR
    IF ERRNO=ERR_EXCRTYMAX TRYNEXT;
    TPWrite "never";
  ENDPROC

  PROC insists()
    zero:=1/zero;
  ERROR
    Incr tries;
    RETRY;
  ENDPROC
ENDMODULE
