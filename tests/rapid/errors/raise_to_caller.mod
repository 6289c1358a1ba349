! RAPID Kernel, Error recovery: without a clause, or with RAISE in it, the caller has the error.
MODULE raise_to_caller
  VAR num zero;

  PROC main()
    without_clause;
    TPWrite "first";                    ! -> first
    raises_again;
    TPWrite "second";                   ! -> second
  ERROR
    TPWrite "in main: "\Bool:=ERRNO=ERR_DIVZERO;
    ! -> in main: TRUE
    ! -> in main: TRUE
    TRYNEXT;
  ENDPROC

  PROC without_clause()
    zero:=1/zero;
    TPWrite "never";
  ENDPROC

  PROC raises_again()
    zero:=1/zero;
    TPWrite "never";
  ERROR
    TPWrite "seen";                     ! -> seen
    RAISE;
  ENDPROC
ENDMODULE
