! RAPID Instructions, ITimer: what repeats takes 0.1 s at least.
MODULE too_short_a_timer
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer 0.05,tick;                   ! stops: a timer of 0.05 s is too short; the least is 0.1 s
  ENDPROC

  TRAP ticks
  ENDTRAP
ENDMODULE
