! RAPID Kernel, Arithmetic operators: dividing by zero is the error ERR_DIVZERO.
MODULE division_by_zero
  VAR num zero;
  VAR num n;

  PROC main()
    n:=1;
    n:=5/zero;                            ! stops: division by zero (ERR_DIVZERO)
    TPWrite "never";
  ENDPROC
ENDMODULE
