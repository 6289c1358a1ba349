MODULE Running
  ! The same work, but the belt runs on while the robot goes down to the part.
  !
  !   rapidsim run programs/belt_pick/Running.mod
  !
  ! reports C106 on the marked line, with how far the part is away by then. Pick.mod shows the remedy:
  ! it stops the belt.

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pPick:=[[50,700,480],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pPick,0,0,120), v1000, fine, tGrip;
    SetDO doRun, 1;
    WaitWObj wBelt\RelDist:=300;
    MoveL pPick, v500, fine, tGrip;
    SetDO doGrip, 1; ! grips nothing
    WaitTime 0.2;
    MoveL Offs(pPick,0,0,120), v500, fine, tGrip;
  ENDPROC
ENDMODULE
