! RAPID Overview, Long jump: LONG_JMP_ALL_ERR takes the errors of traps, too.
MODULE raise_out_of_a_trap_of_all
  VAR intnum tick;
  VAR num zero;
  VAR clock watch;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer \Single,0.5,tick;
    ClkStart watch;
    WaitTime 5;
    TPWrite "at "\Num:=ClkRead(watch);  ! -> at 0.5
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "by zero "\Bool:=ERRNO=ERR_DIVZERO;  ! -> by zero TRUE
    TRYNEXT;
  ENDPROC

  TRAP ticks
    zero:=1/zero;
  ENDTRAP
ENDMODULE
