! RAPID Kernel, INTNO: one trap for several interrupts asks which it was.
MODULE which_interrupt
  VAR intnum first;
  VAR intnum second;

  PROC main()
    CONNECT first WITH both;
    CONNECT second WITH both;
    ITimer \Single,0.4,first;
    ITimer \Single,0.2,second;
    WaitTime 1;
  ENDPROC

  TRAP both
    IF INTNO=first TPWrite "first";     ! -> first
    IF INTNO=second TPWrite "second";   ! -> second
  ENDTRAP
ENDMODULE
