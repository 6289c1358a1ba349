! RAPID Instructions, ISignalDO: a signal that changes raises an interrupt.
MODULE signal_interrupt
  VAR intnum lamp_on;
  VAR signaldo lamp;

  PROC main()
    AliasIO "doLamp",lamp;
    CONNECT lamp_on WITH on_lamp;
    ISignalDO lamp,1,lamp_on;
    Set lamp;
    Reset lamp;
    Set lamp;
    WaitTime 0.1;
  ENDPROC

  TRAP on_lamp
    TPWrite "lamp";
    ! -> lamp
    ! -> lamp
  ENDTRAP
ENDMODULE
