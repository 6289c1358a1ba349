MODULE welding_cell
  ! Picks a bracket, welds it, puts it down. Fourteen faults were planted in it.
  PERS tooldata tTorch:=[TRUE,[[0,0,140],[1,0,0,0]],[-1,[0,0,60],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wTable:=[FALSE,TRUE,"",[[700,0,350],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST jointtarget jHome:=[[0,-10,10,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPick:=[[0,-150,120],[0,0.7,0.7,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pSeam:=[[60,0,150],[0,0,1,0],[0,0,0,9],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[0,150,120],[0,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num nSeams:=3;
  VAR signaldi diPart;
  VAR signaldo doArc;
  VAR num nDone;
  VAR bool bHot;
  VAR string sPart:="bracket";

  PROC main()
    MoveAbsJ jHome,v500,fine,tTorch;
    WaitDI diPart,1;
    PickPart;
    FOR seam FROM 1 TO nSeams DO
      Weld seam;
    ENDFOR
    IF rest(nDone)=0.1 THEN
      TPWrite "nearly "+sPart;
    ENDIF
    bHot:=1;
    MoveJ Offs(pPlace,0,0,80),v500,z20,tTorch\WObj:=wTable;
    MoveL pPlace,v100,fine,tTorch\WObj:=wTable;
    MoveAbsJ jHome,v500,fine,tTorch;
    RETURN;
    MoveJ pPick,v200,fine,tTorch\WObj:=wTable;
  ENDPROC

  PROC PickPart()
    MoveJ Offs(pPick,0,0,50),v500,z50,tTorch\WObj:=wTable;
    WaitTime 0.5;
    MoveL pPcik,v100,fine,tTorch\WObj:=wTable;
    nDone:=0
    WHILE nDone>0 DO
      nDone:=nDone-1;
    ENDWHILE
  ERROR
    TRYNEXT;
  ENDPROC

  PROC Weld(num seam)
    VAR num nPasses:=2;
    MoveL Offs(pSeam,0,10*seam,0),v100,tTorch\WObj:=wTable;
    SetDO doArc,1;
    WaitTime nPasses/seam;
    SetDO doArc,0;
    IF bHot nDone:=nDone+1;
  ENDPROC

  FUNC num rest(num part)
    IF part<3 THEN
      RETURN 3-part;
    ENDIF
  ENDFUNC
ENDMODULE
