! RAPID Instructions, WaitWObj: while the belt stands, no object comes nearer.
MODULE conveyor_stops
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  PROC main()
    VAR clock watch;
    VAR bool late;
    ClkStart watch;
    WaitWObj wCnv\MaxTime:=1\TimeFlag:=late;
    TPWrite ValToStr(late);                 ! -> TRUE
    SetDO doRun,1;
    WaitTime 1;
    SetDO doRun,0;
    WaitTime 3;
    SetDO doRun,1;
    WaitWObj wCnv;
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 6
    DropWObj wCnv;
    WaitDI diPart,0;
    WaitDI diPart,1;
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 11
    WaitWObj wCnv\RelDist:=100;
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 11.5
  ENDPROC
ENDMODULE
