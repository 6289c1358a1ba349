! RAPID Overview, Interrupts: a wait that a trap interrupts ends when it would have ended.
MODULE wait_goes_on
  VAR intnum tick;
  VAR clock watch;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \Single,0.5,tick;
    ClkStart watch;
    WaitTime 2;
    TPWrite "waited "\Num:=ClkRead(watch);       ! -> waited 2
  ENDPROC

  TRAP ticks
    WaitTime 0.75;
    TPWrite "trap at "\Num:=ClkRead(watch);      ! -> trap at 1.25
  ENDTRAP
ENDMODULE
