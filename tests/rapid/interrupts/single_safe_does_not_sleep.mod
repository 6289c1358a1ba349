! RAPID Instructions, ISleep: an interrupt that was ordered with \SingleSafe cannot sleep.
MODULE single_safe_does_not_sleep
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \SingleSafe,0.5,tick;
    ISleep tick;
    WaitTime 1;
    TPWrite "end";                      ! -> end
  ERROR
    TPWrite "safe "\Bool:=ERRNO=ERR_INOISSAFE;   ! -> safe TRUE
    TRYNEXT;
  ENDPROC

  TRAP ticks
    TPWrite "tick";                     ! -> tick
  ENDTRAP
ENDMODULE
