! RAPID Kernel, DIV and MOD: zero divides nothing.
MODULE modulo_zero
  VAR num zero;

  PROC main()
    TPWrite ValToStr(5 MOD zero);         ! stops: 5 MOD 0 (ERR_DIVZERO)
  ENDPROC
ENDMODULE
