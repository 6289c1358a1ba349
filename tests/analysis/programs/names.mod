MODULE names
  ! What is declared where, and what is not declared at all.
  VAR num count:=3;
  LOCAL VAR num hidden;
  VAR num COUNT;                        ! error: N202
  CONST robtarget pPick:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR nmu unknown;                      ! error: N210
  PERS beaddata seam1:=[1,2,[0,0]];
  PERS beaddata seam2:=[3,4,[5,6]];

  PROC main()
    VAR num here;
    VAR bool HERE;                      ! error: N202
    MoveL pPcik,v100,fine,tool0;        ! error: N201
    coutn:=1;                           ! error: N201
    here:=missing+1;                   ! error: N201
    count 1;                            ! error: N211
    here:=helper;                      ! error: N211
    here:=main();                      ! error: N211
    here:=Offs;                        ! error: N211
    helper 1;                           ! error: N211
    here:=MoveL(1);                    ! error: N211
    pPick.trans.w:=1;                   ! error: T304, N212
    here:=pPick.tarns.x;               ! error: N212
    here:=here.x;                     ! error: N212
    seam1:=seam2;
    here:=seam1.speed;                 ! warning: N215
    FOR i FROM 1 TO 3 DO
      here:=i;
    ENDFOR
    here:=i;                           ! error: N201
  ENDPROC

  FUNC num helper()
    RETURN hidden;
  ENDFUNC

  PROC calls()
    OpenGripper;                        ! error: N209
    WaitUntill count=1;                 ! error: N209
    hleper2;                            ! error: N209
    count:=AddOnFunction(1);            ! error: N209
    ArcLike pPick,weld9,\Fast,fine;     ! error: N209
    ArcLike pPcik,weld9;                ! error: N209
    LOCAL VAR num late;                 ! error: N213, E104
  ENDPROC

  PROC scopes()
    PERS num kept:=0;                   ! error: N213
    TASK VAR num shared;                ! error: N213
    kept:=shared;
  ENDPROC
ENDMODULE
