MODULE Standing
  ! The same work, but the robot goes down to where the part was, in a work object that stands.
  !
  !   rapidsim run programs/belt_track/faulty/Standing.mod
  !
  ! reports C106 on the marked line, with how far the part is away by then. Track.mod shows the remedy:
  ! it goes down in the work object of the belt.

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[0.5,[0,0,60],[1,0,0,0],0,0,0.001]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pPart:=[[0,0,40],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWait:=[[420,-100,260],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget here;
    ConfJ\Off;
    ConfL\Off;
    MoveJ pWait, v2500, fine, tGrip;
    WaitWObj wBelt\RelDist:=200;
    MoveL Offs(pPart,0,0,60), v1500, fine, tGrip\WObj:=wBelt;
    here:=CRobT(\Tool:=tGrip\WObj:=wobj0);
    MoveL Offs(here,0,0,-60), v800, fine, tGrip;
    SetDO doGrip, 1; ! grips nothing
    WaitTime 0.1;
    MoveL Offs(here,0,0,80), v1500, fine, tGrip;
    DropWObj wBelt;
  ENDPROC
ENDMODULE
