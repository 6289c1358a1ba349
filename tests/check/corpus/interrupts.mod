MODULE interrupts
  VAR intnum iPart;
  VAR intnum iTime;
  VAR intnum iWatched;
  PERS num watched:=0;
  VAR num seen;
  PROC main()
    CONNECT iPart WITH trPart;
    ISignalDI\Single,diPart,1,iPart;
    CONNECT iTime WITH trTime;
    ITimer\Single,2.5,iTime;
    CONNECT iWatched WITH trTime;
    IPers watched,iWatched;
    IDisable;
    seen:=0;
    IEnable;
    ISleep iTime;
    IWatch iTime;
    WaitUntil seen>0;
    IDelete iPart;
  ENDPROC
  TRAP trPart
    Incr seen;
    ISignalDI\Single,diPart,1,iPart;
  ENDTRAP
  TRAP trTime
    IF INTNO=iTime THEN
      TPWrite "timer";
    ENDIF
  ENDTRAP
ENDMODULE
