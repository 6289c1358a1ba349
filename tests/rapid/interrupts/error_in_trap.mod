! RAPID Overview, Interrupts: an error that a trap does not handle stops the program.
MODULE error_in_trap
  VAR intnum tick;
  VAR num zero;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer\Single,1,tick;
    WaitTime 3;
    TPWrite "never";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC

  TRAP on_tick
    IF zero=0 first;
    zero:=1/zero;                       ! stops: division by zero (ERR_DIVZERO)
  ENDTRAP

  PROC first()
    zero:=1/zero;
  ERROR
    TPWrite "handled";                  ! -> handled
    RETURN;
  ENDPROC
ENDMODULE
