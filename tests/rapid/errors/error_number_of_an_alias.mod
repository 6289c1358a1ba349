! RAPID Kernel, ERRNO: it keeps its number until the next error.
MODULE error_number_of_an_alias
  VAR num zero;
  VAR errnum seen;

  PROC main()
    zero:=1/zero;
    IF seen=ERRNO TPWrite "kept";       ! -> kept
    RAISE 33;
    TPWrite ValToStr(ERRNO);            ! -> 33
  ERROR
    seen:=ERRNO;
    TRYNEXT;
  ENDPROC
ENDMODULE
