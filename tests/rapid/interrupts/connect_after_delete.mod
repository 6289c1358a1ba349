! RAPID Instructions, IDelete: a deleted interrupt may be connected to another trap.
MODULE connect_after_delete
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH first;
    ITimer \Single,0.1,tick;
    WaitTime 0.2;
    IDelete tick;
    CONNECT tick WITH second;
    ITimer \Single,0.1,tick;
    WaitTime 0.2;
  ENDPROC

  TRAP first
    TPWrite "first";                    ! -> first
  ENDTRAP

  TRAP second
    TPWrite "second";                   ! -> second
  ENDTRAP
ENDMODULE
