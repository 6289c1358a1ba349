! RAPID Instructions, WaitWObj: the next object on the conveyor, so far behind the switch.
MODULE conveyor
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  PROC main()
    VAR clock watch;
    VAR bool late;
    ClkStart watch;
    WaitWObj wCnv;
    TPWrite ValToStr(ClkRead(watch));       ! -> 2
    WaitWObj wCnv;
    DropWObj wCnv;
    WaitWObj wCnv\RelDist:=100;
    TPWrite ValToStr(ClkRead(watch));       ! -> 7.5
    DropWObj wCnv;
    WaitWObj wCnv\MaxTime:=1\TimeFlag:=late;
    TPWrite ValToStr(late)+ValToStr(ClkRead(watch)); ! -> TRUE8.5
    WaitWObj wCnv\MaxTime:=1;
    WaitTime 30;
    WaitWObj wCnv\RelDist:=100;
    TPWrite ValToStr(ClkRead(watch));       ! -> 39.5
    DropWObj wCnv;
    DeactUnit CNV1;
    WaitWObj wCnv;
  ERROR
    TPWrite error_name(ERRNO);              ! -> connected ! -> time ! -> not active
    TRYNEXT;
  ENDPROC

  FUNC string error_name(errnum number)
    IF number=ERR_CNV_CONNECT RETURN "connected";
    IF number=ERR_WAIT_MAXTIME RETURN "time";
    IF number=ERR_CNV_NOT_ACT RETURN "not active";
    RETURN "another";
  ENDFUNC
ENDMODULE
