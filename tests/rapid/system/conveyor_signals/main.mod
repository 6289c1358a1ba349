! Application manual Conveyor tracking, "I/O signals": the connection, dropping, and removing the queue.
MODULE conveyor_signals
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p:=[[0,0,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR clock watch;
    ClkStart watch;
    WaitTime 3.5;
    PulseDO c1RemAllPObj;
    WaitWObj wCnv;
    TPWrite ValToStr(ClkRead(watch))+" "+ValToStr(c1Connected); ! -> 4 1
    PulseDO c1DropWObj;
    TPWrite ValToStr(c1Connected);          ! -> 0
    WaitWObj wCnv;
    DropWObj wCnv;
    TPWrite ValToStr(ClkRead(watch))+" "+ValToStr(c1Connected); ! -> 5 0
    WaitWObj wCnv;
    WaitTime 5.5;
    MoveL p,v500,fine,tool0\WObj:=wCnv;
  ERROR
    IF ERRNO=ERR_CNV_DROPPED THEN
      TPWrite "dropped "+ValToStr(c1Connected); ! -> dropped 0
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
