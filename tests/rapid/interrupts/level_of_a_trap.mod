! RAPID Functions, ExecLevel: a trap runs at a level of its own.
MODULE level_of_a_trap
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \Single,0.2,tick;
    TPWrite "normal "\Bool:=ExecLevel()=LEVEL_NORMAL;       ! -> normal TRUE
    WaitTime 0.5;
    TPWrite "normal "\Bool:=ExecLevel()=LEVEL_NORMAL;       ! -> normal TRUE
  ENDPROC

  TRAP ticks
    TPWrite "trap "\Bool:=ExecLevel()=LEVEL_TRAP;           ! -> trap TRUE
  ENDTRAP
ENDMODULE
