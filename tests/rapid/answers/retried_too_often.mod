! RAPID Overview, Error recovery: after the last retry the caller gets another error.
MODULE retried_too_often
  VAR num zero;

  PROC main()
    divides;
    TPWrite "end";                      ! -> end
  ERROR
    TRYNEXT;
  ENDPROC

  PROC divides()
    zero:=1/zero;
    ! answered: ERR_DIVZERO retried by divides 4 times ! answered: ERR_DIVZERO raised by divides
    ! answered: ERR_EXCRTYMAX next by main
  ERROR
    RETRY;
  ENDPROC
ENDMODULE
