! RAPID Overview, UNDO: also where an error of a trap jumps over the routine it interrupted.
MODULE raise_out_of_a_trap_undoes
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    middle;
    TPWrite "end";                      ! -> end
  ERROR (9)
    TPWrite "caught";                   ! -> caught
    TRYNEXT;
  ENDPROC

  PROC middle()
    ITimer \Single,0.2,tick;
    WaitTime 5;
    TPWrite "never";
  UNDO
    TPWrite "undone";                   ! -> undone
  ENDPROC

  TRAP ticks
    RAISE 9;
  ENDTRAP
ENDMODULE
