! RAPID Functions, ClkRead: a clock ends a loop that waits for nothing else.
MODULE timeout_by_clock
  VAR clock watch;

  PROC main()
    VAR num turns;
    ClkReset watch;
    ClkStart watch;
    WHILE ClkRead(watch)<0.5 DO
      turns:=turns+1;
    ENDWHILE
    TPWrite ValToStr(ClkRead(watch));                 ! -> 0.5
    TPWrite ValToStr(turns>1000);                     ! -> TRUE
    ClkStop watch;
    WaitTime 1;
    TPWrite ValToStr(ClkRead(watch));                 ! -> 0.5
    ClkStart watch;
    WaitTime 1;
    TPWrite ValToStr(ClkRead(watch));                 ! -> 1.5
  ENDPROC
ENDMODULE
