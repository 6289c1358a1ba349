MODULE Left
  ! Two robots share a table. Left lays a part in the middle, and Right takes it when Left is away.
  !
  !   rapidsim run programs/two_robots/Left.mod

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wTable:=[FALSE,TRUE,"",[[800,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pStock:=[[-200,-350,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pMiddle:=[[0,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    FOR part FROM 1 TO 2 DO
      MoveJ Offs(pStock,0,0,150), v1000, z50, tGrip\WObj:=wTable;
      MoveL pStock, v300, fine, tGrip\WObj:=wTable;
      MoveL Offs(pStock,0,0,150), v500, fine, tGrip\WObj:=wTable;
      WaitDO doPartInMiddle, 0;
      MoveJ Offs(pMiddle,0,0,150), v1000, z50, tGrip\WObj:=wTable;
      MoveL pMiddle, v300, fine, tGrip\WObj:=wTable;
      MoveL Offs(pMiddle,0,0,150), v500, z50, tGrip\WObj:=wTable;
      MoveJ Offs(pStock,0,0,150), v1000, fine, tGrip\WObj:=wTable;
      SetDO doPartInMiddle, 1;
    ENDFOR
    TPWrite "Left is done";
  ENDPROC
ENDMODULE
