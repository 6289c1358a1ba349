MODULE unknown_things
  ! Add-ins, signals and units that the program does not declare: a run goes on without them.
  PERS beaddata seam1:=[1,2,[0,0]];         ! warning: N210
  PERS beaddata seam2:=[3,4,[5,6]];         ! warning: N210
  PERS weldlist list{2}:=[[1,"a"],[2,"b"]]; ! warning: N210
  VAR num n;
  VAR bool b;
  VAR string s;
  VAR signaldo doAlias;

  PROC main()
    seam1:=seam2;
    list{1}:=list{2};
    OpenGripper;                            ! warning: N209
    n:=AddOnFunction(1)+2;                  ! warning: N209
    n:=2*AddOnFunction(seam1);              ! warning: N209
    b:=AddOnFunction(1) AND n>2;            ! warning: N209
    s:=AddOnFunction(1)+"a";                ! warning: N209
    TPWrite ValToStr(AddOnFunction(-n));    ! warning: N209
    b:=NOT AddOnFunction(1);                ! warning: N209
    ArcLike pWeld,weld9,\Fast,fine;         ! warning: N209
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
