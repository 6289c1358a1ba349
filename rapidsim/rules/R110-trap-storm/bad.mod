MODULE example
  VAR intnum changed;
  PROC main()
    CONNECT changed WITH again;
    ISignalDO doLamp,edge,changed;
    Set doLamp; ! found
  ENDPROC
  TRAP again
    InvertDO doLamp;
  ENDTRAP
ENDMODULE
