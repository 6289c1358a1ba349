MODULE example
  VAR signaldo valve;
  PROC main()
    SetDO valve,1;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR signaldo valve;
  VAR signaldi button;
  VAR signalgo kind;
  VAR intnum pressed;
  VAR num open:=10;
  PROC main()
    CONNECT pressed WITH count;
    ISignalDI button,edge,pressed;
    ISignalDO valve,2,pressed;
    SetDO valve,low;
    SetDO valve,open;
    SetGO kind,2;
    WaitDI button,high\MaxTime:=3;
  ENDPROC
  TRAP count
  ENDTRAP
ENDMODULE
