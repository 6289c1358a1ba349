! RAPID Kernel, Numeric literals: decimal, exponent, hexadecimal, octal and binary.
MODULE numbers
  VAR num n;

  PROC main()
    TPWrite ValToStr(7);        ! -> 7
    TPWrite ValToStr(.5);       ! -> 0.5
    TPWrite ValToStr(5.);       ! -> 5
    TPWrite ValToStr(2.50);     ! -> 2.5
    TPWrite ValToStr(3E2);      ! -> 300
    TPWrite ValToStr(245E-2);   ! -> 2.45
    n:=9E9;
    TPWrite ValToStr(n=9E+09);  ! -> TRUE
    TPWrite ValToStr(n);        ! -> 9E+09
    TPWrite ValToStr(0xFF);     ! -> 255
    TPWrite ValToStr(0Xff);     ! -> 255
    TPWrite ValToStr(0b101);    ! -> 5
    TPWrite ValToStr(0o17);     ! -> 15
    TPWrite ValToStr(-1.5e1);   ! -> -15
  ENDPROC
ENDMODULE
