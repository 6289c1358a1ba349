MODULE palletizing
  CONST num COLUMNS:=4;
  CONST num ROWS:=3;
  PERS tooldata tVacuum:=[TRUE,[[0,0,150],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata wPallet:=[FALSE,TRUE,"",[[800,-300,100],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pPick:=[[500,400,200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pFirst:=[[50,50,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num placed:=0;
  VAR clock cycle;

  PROC main()
    placed:=0;
    ClkReset cycle;
    ClkStart cycle;
    FOR row FROM 1 TO ROWS DO
      FOR column FROM 1 TO COLUMNS DO
        IF placed MOD 4=0 THEN
          TPWrite "layer "\Num:=placed;
        ENDIF
        pick;
        place row,column;
      ENDFOR
    ENDFOR
    ClkStop cycle;
    TPWrite "seconds: "\Num:=ClkRead(cycle);
  ENDPROC

  PROC pick()
    MoveJ Offs(pPick,0,0,100),v1000,z50,tVacuum;
    MoveL pPick,v100,fine,tVacuum;
    Set doVacuum;
    WaitDI diVacuum,1\MaxTime:=2;
    MoveL Offs(pPick,0,0,100),v500,z50,tVacuum;
  ERROR
    IF ERRNO=ERR_WAIT_MAXTIME THEN
      TPWrite "no part";
      RETRY;
    ELSE
      RAISE;
    ENDIF
  ENDPROC

  PROC place(num row,num column)
    VAR robtarget target;

    target:=pFirst;
    target.trans.x:=pFirst.trans.x+(column-1)*120;
    target.trans.y:=pFirst.trans.y+(row-1)*160;
    MoveJ Offs(target,0,0,150),v1000,z50,tVacuum\WObj:=wPallet;
    MoveL target,v200,fine,tVacuum\WObj:=wPallet;
    Reset doVacuum;
    WaitTime 0.3;
    TEST column
    CASE 1,2:
      MoveL Offs(target,0,0,150),v500,z50,tVacuum\WObj:=wPallet;
    CASE 3:
      MoveL Offs(target,0,-20,150),v500,z50,tVacuum\WObj:=wPallet;
    DEFAULT:
      MoveL Offs(target,-20,0,150),v500,z50,tVacuum\WObj:=wPallet;
    ENDTEST
    WHILE TestDI(diBlocked) DO
      WaitTime 0.1;
    ENDWHILE
    Incr placed;
  ENDPROC

  FUNC bool isFull(num limit)
    IF placed>=limit THEN
      RETURN TRUE;
    ENDIF
    RETURN FALSE;
  ENDFUNC
ENDMODULE
