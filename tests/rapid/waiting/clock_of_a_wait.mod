! RAPID Functions, ClkRead: a clock shows the time that was waited, to the millisecond.
MODULE clock_of_a_wait
  VAR clock watch;

  PROC main()
    ClkReset watch;
    ClkStart watch;
    WaitTime 1.234;
    ClkStop watch;
    WaitTime 1;
    TPWrite ValToStr(ClkRead(watch));            ! -> 1.234
    TPWrite ValToStr(ClkRead(watch\HighRes));    ! -> 1.234
    ClkStart watch;
    WaitTime 0.0005;
    TPWrite ValToStr(ClkRead(watch));            ! -> 1.234
    TPWrite ValToStr(ClkRead(watch\HighRes));    ! -> 1.2345
  ENDPROC
ENDMODULE
