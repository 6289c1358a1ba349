! RAPID Overview, Interrupts: CONNECT ties a trap to a number, an order raises it.
MODULE timer
  VAR intnum tick;
  VAR num ticks;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer 1,tick;
    WaitTime 3.5;
    IDelete tick;
    WaitTime 2;
    TPWrite "ticks: "\Num:=ticks;       ! -> ticks: 3
  ENDPROC

  TRAP on_tick
    ticks:=ticks+1;
    IF INTNO<>tick TPWrite "never";
  ENDTRAP
ENDMODULE
