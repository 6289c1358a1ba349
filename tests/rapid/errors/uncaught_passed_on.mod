! RAPID Kernel, RAISE: an error that is only passed on is told where it happened.
MODULE uncaught_passed_on
  VAR num zero;

  PROC main()
    compute;
  ENDPROC

  PROC compute()
    zero:=1/zero;                       ! stops: division by zero (ERR_DIVZERO)
  ERROR
    TPWrite "passed on";                ! -> passed on
    RAISE;
  ENDPROC
ENDMODULE
