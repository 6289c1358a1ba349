! Field practice, Signs: behind an operator the strict syntax has none; what is meant is clear.
MODULE signs
  VAR num n:=3;

  PROC main()
    TPWrite ValToStr(n*-2);       ! note: E146 ! -> -6
    TPWrite ValToStr(n*+2);       ! note: E146 ! -> 6
    TPWrite ValToStr(n--2);       ! note: E146 ! -> 5
    TPWrite ValToStr(n*(-2));     ! -> -6
  ENDPROC
ENDMODULE
