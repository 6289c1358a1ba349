! RAPID Kernel, DIV and MOD: whole numbers, cut off towards zero.
MODULE integer_division
  VAR num seven:=7;

  PROC main()
    TPWrite ValToStr(seven DIV 2);        ! -> 3
    TPWrite ValToStr(seven MOD 2);        ! -> 1
    TPWrite ValToStr(-seven DIV 2);       ! -> -3
    TPWrite ValToStr(-seven MOD 2);       ! -> -1
    TPWrite ValToStr(seven/2);            ! -> 3.5
    seven:=7.5;
    TPWrite ValToStr(seven DIV 2);        ! stops: DIV takes integers, not 7.5 (ERR_INT_NOTVAL)
  ENDPROC
ENDMODULE
