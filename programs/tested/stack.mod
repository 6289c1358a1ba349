MODULE stack
  ! Boxes on a pallet: three in a row, two rows a layer. The tests beside it run under pytest:
  !
  !   pytest programs/tested

  TASK PERS tooldata tVacuum:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wPallet:=[FALSE,TRUE,"",[[600,-150,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pFirst:=[[0,0,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num boxLength:=120;
  CONST num boxWidth:=100;
  CONST num boxHeight:=80;
  PERS num nPlaced:=0;

  FUNC num layerOf(num box)
    RETURN (box-1) DIV 6+1;
  ENDFUNC

  FUNC num rowOf(num box)
    RETURN ((box-1) MOD 6) DIV 3+1;
  ENDFUNC

  FUNC robtarget placeOf(num box)
    IF box<1 RAISE ERR_ARGVALERR;
    RETURN Offs(pFirst,((box-1) MOD 3)*boxLength,(rowOf(box)-1)*boxWidth,layerOf(box)*boxHeight);
  ENDFUNC

  PROC place(num box)
    MoveJ Offs(placeOf(box),0,0,100),v1000,z20,tVacuum\WObj:=wPallet;
    MoveL placeOf(box),v200,fine,tVacuum\WObj:=wPallet;
    SetDO doVacuum,0;
    WaitTime 0.2;
    nPlaced:=nPlaced+1;
    MoveL Offs(placeOf(box),0,0,100),v500,z20,tVacuum\WObj:=wPallet;
  ENDPROC

  PROC main()
    nPlaced:=0;
    FOR box FROM 1 TO 6 DO
      place box;
    ENDFOR
  ENDPROC
ENDMODULE
