%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
MODULE cell(SYSMODULE)
  ! Nothing is wrong here.
  RECORD pallet
    pos corner;
    num rows;
    string label;
  ENDRECORD
  ALIAS num level;
  CONST num ROWS:=4;
  TASK PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[1.2,[0,0,60],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wTable:=[FALSE,TRUE,"",[[500,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pHome:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E+09,9E+09,9E9,9E9,9E9,9E9]];
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pallet pallets{2}:=[[[0,0,0],4,"left"],[[500,0,0],ROWS,"right"]];
  PERS num heights{2,3}:=[[1,2,3],[4,5,6]];
  LOCAL VAR intnum timer;
  VAR iodev logfile;
  VAR clock watch;
  VAR level depth;
  VAR errnum ERR_EMPTY:=-1;
  VAR num reading;

  PROC Main()
    VAR num k:=0;
    VAR robtarget here;
    VAR string text:="n=";
    VAR bool ok;
    ConfJ\On;
    AccSet 80,80;
    MoveAbsJ jHome\NoEOffs,v1000,fine,tGrip\WObj:=wTable;
    FOR row FROM 1 TO pallets{1}.rows STEP 1 DO
      place 1,row\lift:=50;
    ENDFOR
    FOR row FROM ROWS TO 1 DO
      place 2,row\fast;
    ENDFOR
    here:=CRobT(\Tool:=tGrip\WObj:=wTable);
    here.trans.z:=here.trans.z+heights{1,2};
    pallets{2}.corner.x:=here.trans.x-pallets{1}.corner.x;
    wTable.oframe.trans.x:=k;
    text:=text+NumToStr(k,2)+ValToStr(here);
    TPWrite text\Num:=k;
    ok:=StrToVal("12.5",k) AND k>12 OR NOT ok;
    IF ok AND Present_like(k) TPErase;
    Open "HOME:"\File:="LOG.TXT",logfile\Write;
    Write logfile,"height "\Num:=depth;
    Close logfile;
    IDelete timer;
    CONNECT timer WITH tick;
    ITimer 0.5,timer;
    ClkReset watch;
    ClkStart watch;
    WHILE ClkRead(watch)<1 AND k<>3 DO
      k:=k+1;
      IF k=2 GOTO done;
    ENDWHILE
    done:
    TEST k
    CASE 1,2:
      %"place_"+NumToStr(k,0)%;
    CASE 3:
      CallByVar "place_",k;
    DEFAULT:
      Stop;
    ENDTEST
    WaitTime\InPos,0.5;
    reg1:=reg1+1;
    EXIT;
  ERROR
    IF ERRNO=ERR_EMPTY THEN
      TPWrite "empty";
      TRYNEXT;
    ELSE
      RAISE;
    ENDIF
  ENDPROC

  LOCAL PROC place(num which,num row\num lift|switch fast)
    VAR robtarget target;
    VAR speeddata speed:=[200,500,5000,1000];
    target:=Offs(pHome,pallets{which}.corner.x,pallets{which}.corner.y,row*20);
    IF Present(lift) target.trans.z:=target.trans.z+lift;
    IF Present(fast) speed:=v1000;
    MoveL RelTool(target,0,0,-50\Rz:=90),speed,z10,tGrip\WObj:=wTable;
    MoveL target,speed,fine,tGrip\WObj:=wTable;
    MoveC Offs(target,10,10,0),Offs(target,20,0,0),v100,z1,tGrip\WObj:=wTable;
    MoveL [[600,0,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v50,fine,tGrip;
    IF row>ROWS RAISE ERR_EMPTY;
    swap which,row;
  ENDPROC

  PROC place_1()
    place 1,1\fast;
  ENDPROC

  PROC swap(INOUT num a,INOUT num b)
    VAR num kept;
    kept:=a;
    a:=b;
    b:=kept;
  ENDPROC

  FUNC bool Present_like(num value\switch strict)
    IF Present(strict) THEN
      RETURN value>0;
    ELSEIF value=0 THEN
      RETURN FALSE;
    ELSE
      RETURN largest(heights)>value;
    ENDIF
  ENDFUNC

  FUNC num largest(num table{*,*})
    VAR num best:=-9E9;
    FOR i FROM 1 TO Dim(table,1) DO
      FOR j FROM 1 TO Dim(table,2) DO
        IF table{i,j}>best best:=table{i,j};
      ENDFOR
    ENDFOR
    RETURN best;
  ENDFUNC

  TRAP tick
    reading:=reading+1;
    TPWrite "tick"\Num:=reading;
  ENDTRAP
ENDMODULE
