MODULE arguments
  CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num fixed:=3;
  VAR num n;
  VAR dnum d;
  PERS num kept:=0;
  PERS num counts{3}:=[0,0,0];
  VAR tooldata tVar:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  VAR signaldo doLamp;
  VAR num list{4};

  PROC main()
    MoveL p1,v100,fine,tGrip;
    MoveL p1,v100,fine,tGrip\WObj:=wobj0;
    MoveL\Conc,p1,v100,fine,tGrip;
    MoveJ Offs(p1,0,0,50),[100,500,5000,1000],z10,tool0;
    MoveL p1,v100,tGrip;                    ! error: T302
    MoveL p1,v100,z50;                      ! error: T302
    MoveL p1,v100,fine,tGrip,wobj0;         ! error: T302
    MoveL p1,v100,fine,tGrip\Conc;          ! error: T302
    MoveL p1\WObj:=wobj0,v100,fine,tGrip;   ! error: T302
    MoveL p1,v100,fine,tGrip\Wob:=wobj0;    ! error: T312
    MoveL p1,v100,fine,tVar;                ! error: T303
    MoveL p1,v100,fine,[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]; ! error: T303
    MoveL p1,v100\V:=50\T:=2,fine,tool0;    ! error: T315
    MoveL p1,v100\T,fine,tool0;             ! error: T315
    MoveL\Conc:=TRUE,p1,v100,fine,tool0;    ! error: T315
    MoveL p1,fine,v100,tool0;               ! error: T302
    MoveL p1,v100,fine,tool0\WObj:=wobj0\WObj:=wobj0; ! error: T315
    ConfL\On\Off;                           ! error: T315
    Incr n;
    Incr d;
    Incr kept;
    Incr list{2};
    Incr counts{2};                         ! warning: T323
    Incr fixed;                             ! error: T303
    Incr n+1;                               ! error: T303
    Incr p1;                                ! error: T301
    Add n,2;
    Add d,2;
    SetDO doLamp,1;
    SetDO doUnknown,1;                      ! warning: I801
    Set doUnknown;
    IF doUnknown=1 Reset doLamp;
    IF diDoor=1 Reset doLamp;               ! warning: I801
    WaitDI diDoor,high;
    WaitUntil diDoor=1 AND n>2\MaxTime:=5;
    ActUnit STN_9;                          ! note: N214
    own 1,n,n,kept\fast;
    own 1,n,n,kept\slow,5;                  ! error: T302, T315
    own 1,n,n,kept\slow:=5;
    own 1,n,n,kept\fast\slow:=5;            ! error: T315
    own 1,n,kept,kept;                      ! error: T303
    own 1,kept,n,n;                         ! error: T303
    own 1,fixed,n,kept;                     ! error: T303
    own b:=n,c:=n,d:=kept,a:=1;             ! error: T302, T302
    own a:=1,b:=n,c:=n,d:=kept;
    own (1),n,n,kept;
    total list;
    total counts;
    total n;                                ! error: T301
    %"own"% 1,n,n,kept;
    %n%;                                    ! error: T301
  ENDPROC

  PROC own(num a,INOUT num b,VAR num c,PERS num d\switch fast|num slow)
    IF Present(slow) pass_on\slow?slow\fast?fast;
    pass_on\slow?a;                         ! error: T315
    a:=a+1;
    Incr a;
    Incr b;
    b:=c+d;
  ENDPROC

  PROC pass_on(\switch fast|num slow)
    IF Present(fast) RETURN;
  ENDPROC

  PROC total(num values{*})
    VAR num sum;
    FOR i FROM 1 TO Dim(values,1) DO
      sum:=sum+values{i};
      Incr i;                               ! error: T303
    ENDFOR
  ENDPROC
ENDMODULE
