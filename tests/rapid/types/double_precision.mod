! RAPID Kernel, Data type dnum: all operators of num, with 52 bits.
MODULE double_precision
  VAR dnum d:=4503599627370495;
  VAR num n;

  PROC main()
    TPWrite DnumToStr(d DIV 2,0);           ! -> 2251799813685247
    TPWrite ValToStr(d MOD 10);           ! -> 5
    TPWrite DnumToStr(-d+1,0);               ! -> -4503599627370494
    TPWrite ValToStr(d>=4503599627370495);! -> TRUE
    d:=1;
    TPWrite ValToStr(d/3);                ! -> 0.333333333333333
    n:=1;
    TPWrite ValToStr(n/3);                ! -> 0.333333
    TEST d
    CASE 1:
      TPWrite "one";                      ! -> one
    ENDTEST
  ENDPROC
ENDMODULE
