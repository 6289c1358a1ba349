! RAPID Instructions, CONNECT: the interrupt variable is none of a routine, which it outlives.
MODULE connect_data_of_a_routine
  PROC main()
    VAR intnum tick;
    CONNECT tick WITH ticks;            ! error: F416
  ENDPROC

  TRAP ticks
  ENDTRAP
ENDMODULE
