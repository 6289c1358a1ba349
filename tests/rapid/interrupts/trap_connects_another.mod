! RAPID Instructions, IDelete and CONNECT: a trap may give its own interrupt to another trap.
MODULE trap_connects_another
  VAR intnum tick;
  VAR num ticks;

  PROC main()
    CONNECT tick WITH first;
    ITimer 1,tick;
    WaitUntil ticks>=12\PollRate:=0.1;
    TPWrite "ticks "\Num:=ticks;             ! -> ticks 12
    IDelete tick;
  ENDPROC

  TRAP first
    Incr ticks;
    IF ticks<2 RETURN;
    IDelete tick;
    CONNECT tick WITH second;
    ITimer 0.5,tick;
  ENDTRAP

  TRAP second
    ticks:=ticks+10;
  ENDTRAP
ENDMODULE
