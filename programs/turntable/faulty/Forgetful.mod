MODULE Forgetful
  ! The same table, but the program takes the blank where it has put it: the work object does not turn.
  !
  !   rapidsim run programs/turntable/Forgetful.mod
  !
  ! reports C106 on the marked line: the table has turned the blank away. Load.mod shows the remedy: a
  ! work object that STN1 carries.

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wPlate:=[FALSE,TRUE,"",[[700,0,400],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pTray:=[[450,600,480],[0,0,1,0],[0,0,-1,0],[9E9,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlate:=[[-180,0,81],[0,0,1,0],[0,0,-1,0],[9E9,0,9E9,9E9,9E9,9E9]];
  CONST robtarget pAgain:=[[-180,0,80],[0,0,1,0],[0,0,-1,0],[9E9,180,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pTray,0,0,120), v1000, z20, tGrip;
    MoveL pTray, v300, fine, tGrip;
    SetDO doGrip, 1;
    WaitTime 0.3;
    MoveL Offs(pTray,0,0,120), v500, z20, tGrip;
    MoveJ Offs(pPlate,0,0,120), v1000, z20, tGrip\WObj:=wPlate;
    MoveL pPlate, v300, fine, tGrip\WObj:=wPlate;
    SetDO doGrip, 0;
    WaitTime 0.3;
    MoveL Offs(pPlate,0,0,120), v500, fine, tGrip\WObj:=wPlate;
    MoveJ Offs(pAgain,0,0,120), v1000, fine, tGrip\WObj:=wPlate;
    MoveL pAgain, v300, fine, tGrip\WObj:=wPlate;
    SetDO doGrip, 1; ! grips nothing
    WaitTime 0.3;
    MoveL Offs(pAgain,0,0,120), v500, fine, tGrip\WObj:=wPlate;
  ENDPROC
ENDMODULE
