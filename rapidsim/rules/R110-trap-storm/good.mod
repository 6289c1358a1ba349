MODULE example
  VAR intnum changed;
  PROC main()
    CONNECT changed WITH again;
    ISignalDO doLamp,edge,changed;
    Set doLamp;
  ENDPROC
  TRAP again
    InvertDO doOther;
  ENDTRAP
ENDMODULE
