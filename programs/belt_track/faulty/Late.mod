MODULE Late
  ! The same work, but the robot waits with the connected part until that has almost passed.
  !
  !   rapidsim run programs/belt_track/faulty/Late.mod
  !
  ! ends with ERR_CNV_DROPPED on the line that is marked: the part is farther from the switch than
  ! `maximum`. Track.mod shows the remedy: it goes as soon as the part is there.

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[0.5,[0,0,60],[1,0,0,0],0,0,0.001]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pPart:=[[0,0,40],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWait:=[[420,-100,260],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ pWait, v2500, fine, tGrip;
    WaitWObj wBelt\RelDist:=200;
    WaitTime 1.8;
    MoveL Offs(pPart,0,0,60), v1500, z20, tGrip\WObj:=wBelt; ! comes too late
    MoveL pPart, v800, fine, tGrip\WObj:=wBelt;
    SetDO doGrip, 1;
    DropWObj wBelt;
  ENDPROC
ENDMODULE
