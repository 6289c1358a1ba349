! RAPID Overview, Interrupts: an error of a trap that no clause lists stops the program.
MODULE raise_out_of_a_trap_uncaught
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \Single,0.5,tick;
    WaitTime 5;
    TPWrite "never";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC

  TRAP ticks
    RAISE 9;                            ! stops: the program raised error 9
  ENDTRAP
ENDMODULE
