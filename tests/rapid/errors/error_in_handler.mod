! RAPID Kernel, Error recovery: an error in an ERROR clause goes past all others and stops.
MODULE error_in_handler
  VAR num zero;

  PROC main()
    inner;
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC

  PROC inner()
    RAISE 1;
  ERROR
    zero:=1/zero;                       ! stops: division by zero (ERR_DIVZERO)
    TRYNEXT;
  ENDPROC
ENDMODULE
