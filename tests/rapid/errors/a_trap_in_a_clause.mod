! RAPID Overview, Interrupts: a trap that interrupts an ERROR clause runs in no clause itself.
MODULE a_trap_in_a_clause
  VAR num zero;
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    zero:=1/zero;
    TPWrite "next";                     ! -> next
  ERROR
    ITimer \Single,0.2,tick;
    WaitTime 0.5;
    TPWrite "clause "\Bool:=ExecHandler()=HANDLER_ERR;      ! -> clause TRUE
    TPWrite "number "\Bool:=ERRNO=ERR_DIVZERO;              ! -> number TRUE
    TRYNEXT;
  ENDPROC

  TRAP ticks
    TPWrite "trap "\Bool:=ExecHandler()=HANDLER_NONE;       ! -> trap TRUE
    ERASE;
  ENDTRAP

  PROC ERASE()
    zero:=1/zero;
  ERROR
    TPWrite "of the trap";              ! -> of the trap
    TRYNEXT;
  ENDPROC
ENDMODULE
