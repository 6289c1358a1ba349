! RAPID Overview, Interrupts: the ERROR clause of the trap itself comes first.
MODULE error_in_a_trap_is_handled
  VAR intnum tick;
  VAR num zero;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \Single,0.2,tick;
    WaitTime 1;
    TPWrite "end";                      ! -> end
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "never";
  ENDPROC

  TRAP ticks
    zero:=1/zero;
    TPWrite "trap goes on";             ! -> trap goes on
  ERROR
    TPWrite "handled";                  ! -> handled
    TRYNEXT;
  ENDTRAP
ENDMODULE
