MODULE unknown_things
  ! Routines and types that nothing declares are errors, signals and units are not.
  PERS beaddata seam1:=[1,2,[0,0]];
  PERS beaddata seam2:=[3,4,[5,6]];
  PERS weldlist list{2}:=[[1,"a"],[2,"b"]]; ! error: N210
  VAR num n;
  VAR bool b;
  VAR string s;
  VAR signaldo doAlias;

  PROC main()
    seam1:=seam2;
    list{1}:=list{2};
    OpenGripper;                            ! error: N209
    n:=AddOnFunction(1)+2;                  ! error: N209
    n:=2*AddOnFunction(seam1);              ! error: N209
    b:=AddOnFunction(1) AND n>2;            ! error: N209
    s:=AddOnFunction(1)+"a";                ! error: N209
    TPWrite ValToStr(AddOnFunction(-n));    ! error: N209
    b:=NOT AddOnFunction(1);                ! error: N209
    ArcLike pWeld,weld9,\Fast,fine;         ! error: N209
    IF diDoor=1 AND doLamp=0 n:=diDoor;     ! warning: I801, I801
    AliasIO doConfigured,doAlias;           ! warning: I801
    WaitUntil giPart>3 AND diDoor=high;     ! warning: I801
    SetDO\SDelay:=0.2,doLamp,1;
    PulseDO\PLength:=0.5,doLamp;
    ISignalDI DI10_1,1,timer;               ! warning: I801
    ActUnit STN_9;                          ! note: N214
    MoveL *,v100,fine,tool0;                ! warning: E148
    n:=<EXP>;                               ! warning: E148
    <SMT>                                   ! warning: E148
  ENDPROC

  VAR intnum timer;
ENDMODULE
