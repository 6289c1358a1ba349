MODULE Load
  ! The robot puts a blank on a turntable, which turns by half; then it takes the blank off again where
  ! the table has brought it.
  !
  !   rapidsim run programs/turntable/Load.mod
  !
  ! What is in the cell is in rapidsim.toml: the blank turns with the table, as it rests on it.

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wTable:=[FALSE,FALSE,"STN1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pTray:=[[450,600,480],[0,0,1,0],[0,0,-1,0],[9E9,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlate:=[[-180,0,81],[0,0,1,0],[0,0,-1,0],[9E9,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pTurned:=[[-180,0,80],[0,0,1,0],[0,0,-1,0],[9E9,180,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pTray,0,0,120), v1000, z20, tGrip;
    MoveL pTray, v300, fine, tGrip;
    SetDO doGrip, 1;
    WaitTime 0.3;
    MoveL Offs(pTray,0,0,120), v500, z20, tGrip;
    MoveJ Offs(pPlate,0,0,120), v1000, z20, tGrip\WObj:=wTable;
    MoveL pPlate, v300, fine, tGrip\WObj:=wTable;
    SetDO doGrip, 0;
    WaitTime 0.3;
    MoveL Offs(pPlate,0,0,120), v500, fine, tGrip\WObj:=wTable;
    MoveJ Offs(pTurned,0,0,120), v1000, fine, tGrip\WObj:=wTable;
    MoveL pTurned, v300, fine, tGrip\WObj:=wTable;
    SetDO doGrip, 1;
    WaitTime 0.3;
    MoveL Offs(pTurned,0,0,120), v500, z20, tGrip\WObj:=wTable;
    PutBack;
  ENDPROC

  PROC PutBack()
    VAR robtarget back;
    back:=pTray;
    back.extax.eax_b:=180;
    MoveJ Offs(back,0,0,120), v1000, z20, tGrip;
    MoveL back, v300, fine, tGrip;
    SetDO doGrip, 0;
    WaitTime 0.3;
    MoveL Offs(back,0,0,120), v500, fine, tGrip;
  ENDPROC
ENDMODULE
