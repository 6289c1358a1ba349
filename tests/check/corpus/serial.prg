MODULE serial
  VAR iodev port;
  VAR string line;
  VAR num value;
  VAR bool ok;
  PROC main()
    Open "com2:",port\Bin;
    ClearIOBuff port;
    WriteStrBin port,"\02?\03";
    line:=ReadStrBin(port,8\Time:=2);
    ok:=StrToVal(line,value);
    IF NOT ok THEN
      ErrWrite\W,"Scale","No weight"\RL2:=line\RL3:="check the cable";
    ENDIF
    Close port;
  ENDPROC
ENDMODULE
