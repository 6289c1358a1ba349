MODULE Pick
  ! The robot waits until a part has travelled 300 mm behind the switch, stops the belt, and puts the
  ! part into a box.
  !
  !   rapidsim run programs/belt_pick/Pick.mod

  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[2,[0,0,60],[1,0,0,0],0,0,0.01]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pPick:=[[50,700,480],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBox:=[[600,-120,481],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pPick,0,0,120), v1000, fine, tGrip;
    FOR i FROM 0 TO 2 DO
      SetDO doRun, 1;
      WaitWObj wBelt\RelDist:=300;
      SetDO doRun, 0;
      DropWObj wBelt;
      MoveL pPick, v500, fine, tGrip;
      SetDO doGrip, 1;
      WaitTime 0.2;
      MoveL Offs(pPick,0,0,120), v500, z20, tGrip;
      MoveJ Offs(pBox,0,120*i,120), v1000, z20, tGrip;
      MoveL Offs(pBox,0,120*i,0), v500, fine, tGrip;
      SetDO doGrip, 0;
      WaitTime 0.2;
      MoveL Offs(pBox,0,120*i,120), v500, z20, tGrip;
      MoveJ Offs(pPick,0,0,120), v1000, fine, tGrip;
    ENDFOR
  ENDPROC
ENDMODULE
