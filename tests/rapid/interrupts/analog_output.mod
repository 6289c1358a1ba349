! RAPID Instructions, ISignalAO: an interrupt when an analog output comes above a value.
MODULE analog_output
  VAR intnum above;
  VAR signalao aoFlow;

  PROC main()
    AliasIO "aoFlow",aoFlow;
    CONNECT above WITH on_above;
    ISignalAO aoFlow,AIO_ABOVE_HIGH,2,1,0,above;
    SetAO aoFlow,1;
    WaitTime 0.1;
    SetAO aoFlow,3;
    WaitTime 0.1;
    SetAO aoFlow,1.5;
    WaitTime 0.1;
    TPWrite "end";                          ! -> end
  ENDPROC

  TRAP on_above
    TPWrite "above "\Num:=AOutput(aoFlow);  ! -> above 3
  ENDTRAP
ENDMODULE
