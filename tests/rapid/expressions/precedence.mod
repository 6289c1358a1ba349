! RAPID Kernel, Expressions: * / DIV MOD, then + -, then relations, then AND, then OR XOR NOT.
MODULE precedence
  PROC main()
    TPWrite ValToStr(2+3*4);            ! -> 14
    TPWrite ValToStr((2+3)*4);          ! -> 20
    TPWrite ValToStr(20-5-3);           ! -> 12
    TPWrite ValToStr(24/4/2);           ! -> 3
    TPWrite ValToStr(7 DIV 2*2);        ! -> 6
    TPWrite ValToStr(2+7 MOD 4);        ! -> 5
    TPWrite ValToStr(-2+5);             ! -> 3
    TPWrite ValToStr(+2-+5);            ! -> -3
    ! note: E146
    TPWrite ValToStr(1+1=2);            ! -> TRUE
    TPWrite ValToStr(2>1 AND 1>=1);     ! -> TRUE
    TPWrite ValToStr(1<=0 OR 1<2);      ! -> TRUE
  ENDPROC
ENDMODULE
