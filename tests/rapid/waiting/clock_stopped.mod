! RAPID Instructions, ITimer: cyclic until it is deleted; a clock stopped and started again adds up.
MODULE clock_stopped
  VAR intnum tick;
  VAR num count:=0;
  VAR clock c;

  PROC main()
    CONNECT tick WITH counts;
    ITimer 0.25,tick;
    ClkStart c;
    WaitTime 1.1;
    IDelete tick;
    WaitTime 1;
    ClkStop c;
    WaitTime 1;
    ClkStart c;
    WaitTime 0.4;
    ClkStop c;
    TPWrite ValToStr(count);                ! -> 4
    TPWrite ValToStr(Round(ClkRead(c)\Dec:=2)); ! -> 2.5
    ClkReset c;
    TPWrite ValToStr(ClkRead(c\HighRes));   ! -> 0
  ENDPROC

  TRAP counts
    count:=count+1;
  ENDTRAP
ENDMODULE
