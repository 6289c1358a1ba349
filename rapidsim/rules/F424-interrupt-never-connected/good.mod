MODULE example
  VAR intnum part_seen;
  VAR signaldi sensor;
  PROC main()
    CONNECT part_seen WITH count;
    ISignalDI sensor,1,part_seen;
  ENDPROC
  TRAP count
  ENDTRAP
ENDMODULE
! ---
MODULE near_miss
  VAR intnum elsewhere;
  VAR intnum copy;
  VAR intnum each{3};
  PROC main()
    order elsewhere;
    ITimer 1,elsewhere;
    copy:=elsewhere;
    ISleep copy;
    CONNECT each{1} WITH count;
    ITimer 1,each{1};
    IDelete each{1};
  ENDPROC
  PROC order(VAR intnum number)
    CONNECT number WITH count;
    ITimer 2,number;
  ENDPROC
  TRAP count
  ENDTRAP
ENDMODULE
