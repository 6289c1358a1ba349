MODULE Hasty
  ! The same work in a hurry: the way from the tray goes straight to above the vice, and the part does
  ! not pass the frame of the door.
  !
  !   rapidsim run programs/machine_tending/Hasty.mod
  !
  ! reports C101 on the marked line. Tending.mod shows the remedy: a point before the door.

  PERS tooldata tGrip:=[TRUE,[[0,0,160],[1,0,0,0]],[2,[0,0,80],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wTray:=[FALSE,TRUE,"",[[150,-750,400],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS wobjdata wVice:=[FALSE,TRUE,"",[[950,0,420],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pTray:=[[0,0,100],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pVice:=[[0,0,150],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pTray,0,0,150), v1000, z20, tGrip\WObj:=wTray;
    MoveL pTray, v200, fine, tGrip\WObj:=wTray;
    SetDO doGrip, 1;
    WaitTime 0.3;
    MoveL Offs(pTray,0,0,250), v500, z20, tGrip\WObj:=wTray;
    MoveJ Offs(pVice,0,0,120), v500, z5, tGrip\WObj:=wVice; ! hits the frame
    MoveL pVice, v100, fine, tGrip\WObj:=wVice;
    SetDO doGrip, 0;
  ENDPROC
ENDMODULE
