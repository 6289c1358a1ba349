MODULE example
  VAR intnum part_seen;
  VAR signaldi sensor;
  PROC main()
    ISignalDI sensor,1,part_seen; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR intnum part_gone;
  VAR intnum part_seen;
  VAR intnum each{3};
  PROC main()
    CONNECT part_gone WITH count;
    ITimer 1,part_gone;
    ITimer 1,part_seen;           ! found
    ISleep part_seen;             ! found
    ITimer 1,each{2};             ! found
    IDelete part_seen;
  ENDPROC
  TRAP count
  ENDTRAP
ENDMODULE
