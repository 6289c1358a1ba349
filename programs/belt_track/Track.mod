MODULE Track
  ! A belt that never stops brings a part every 2 s. The robot takes each as it passes, and puts it into
  ! a box: 30 parts a minute.
  !
  !   rapidsim run programs/belt_track/Track.mod

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[0.5,[0,0,60],[1,0,0,0],0,0,0.001]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  ! On the belt: the top of a part.
  CONST robtarget pPart:=[[0,0,40],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pWait:=[[420,-100,260],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBox:=[[170,-370,91],[0,0.7071068,0.7071068,0],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ pWait, v2500, fine, tGrip;
    FOR i FROM 0 TO 5 DO
      pick;
      place i;
    ENDFOR
  ENDPROC

  PROC pick()
    WaitWObj wBelt\RelDist:=200;
    MoveL Offs(pPart,0,0,60), v1500, z20, tGrip\WObj:=wBelt;
    MoveL pPart, v800, fine, tGrip\WObj:=wBelt;
    SetDO doGrip, 1;
    WaitTime 0.1;
    MoveL Offs(pPart,0,0,80), v1500, z20, tGrip\WObj:=wBelt;
  ENDPROC

  PROC place(num i)
    VAR robtarget here;
    here:=Offs(pBox,60*(i MOD 3),60*(i DIV 3),0);
    MoveJ Offs(here,0,0,80), v2500, z20, tGrip;
    DropWObj wBelt;
    MoveL here, v800, fine, tGrip;
    SetDO doGrip, 0;
    WaitTime 0.1;
    MoveL Offs(here,0,0,80), v1500, z20, tGrip;
    MoveJ pWait, v2500, fine, tGrip;
  ENDPROC
ENDMODULE
