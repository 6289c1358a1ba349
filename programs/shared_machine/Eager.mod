MODULE Eager
  ! The same work without waiting for the other robot: both reach for the vice at the same time.
  !
  !   rapidsim run programs/shared_machine/Eager.mod
  !
  ! reports C101 on the marked line. Load.mod shows the remedy: it waits for a signal at the door.

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,160],[1,0,0,0]],[2,[0,0,80],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wTray:=[FALSE,TRUE,"",[[150,-750,400],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  TASK PERS wobjdata wVice:=[FALSE,TRUE,"",[[950,0,420],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  ! The part is 100 mm high; it is gripped at its top.
  CONST robtarget pTray:=[[0,0,100],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pVice:=[[0,0,150],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pDoor:=[[-350,0,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pTray,0,0,150), v1000, z20, tGrip\WObj:=wTray;
    MoveL pTray, v200, fine, tGrip\WObj:=wTray;
    SetDO doGrip, 1;
    WaitTime 0.3;
    MoveL Offs(pTray,0,0,250), v500, z20, tGrip\WObj:=wTray;
    MoveJ pDoor, v1000, fine, tGrip\WObj:=wVice;
    MoveL Offs(pVice,0,0,120), v500, z5, tGrip\WObj:=wVice; ! hits the other robot
    MoveL pVice, v100, fine, tGrip\WObj:=wVice;
    SetDO doGrip, 0;
    WaitTime 0.3;
    MoveL Offs(pVice,0,0,120), v500, z5, tGrip\WObj:=wVice;
    MoveL pDoor, v1000, fine, tGrip\WObj:=wVice;
  ENDPROC
ENDMODULE
