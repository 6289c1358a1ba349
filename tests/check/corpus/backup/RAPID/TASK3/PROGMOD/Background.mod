MODULE Background
  PERS bool bAlive:=TRUE;
  VAR num nBeat;
  PROC main()
    Incr nBeat;
    IF nBeat MOD 2=0 THEN SetDO doBeat,1;
    ELSE SetDO doBeat,0;
    ENDIF
    bAlive:=NOT bAlive;
    WaitTime 0.5;
  ENDPROC
ENDMODULE
