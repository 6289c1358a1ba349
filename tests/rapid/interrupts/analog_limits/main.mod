! RAPID Instructions, ISignalAI: bounds that the signal never reaches are refused with ERR_AO_LIM.
MODULE analog_limits
  VAR intnum high;
  VAR intnum low;

  PROC main()
    CONNECT high WITH on_flow;
    CONNECT low WITH on_flow;
    order;
    ISignalAI aiFlow,AIO_BELOW_LOW,10,-0.5,0,low;
    TPWrite "ordered";
  ERROR
    TPWrite "below "\Bool:=ERRNO=ERR_AO_LIM;         ! -> below TRUE
    RETURN;
  ENDPROC

  PROC order()
    VAR num most:=12;
    ISignalAO aoFlow,AIO_ABOVE_HIGH,most,0,0,high;
    SetAO aoFlow,10;
    WaitTime 0.1;
  ERROR
    IF ERRNO=ERR_AO_LIM THEN
      TPWrite "above";          ! -> above
      most:=8;
      RETRY;
    ENDIF
  ENDPROC

  TRAP on_flow
    TPWrite "flow "\Num:=aoFlow;         ! -> flow 10
  ENDTRAP
ENDMODULE
