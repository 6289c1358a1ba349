MODULE Trusting
  ! The same work, but the left arm only waits for a while, and not for the grip of the right one.
  !
  !   rapidsim run programs/hand_over/Trusting.mod
  !
  ! reports C105 on the marked line: nothing holds the part. Left.mod shows the remedy.

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0.01]];
  CONST robtarget pStand:=[[450,600,560],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pMiddle:=[[750,0,780],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pStand,0,0,150), v1000, z10, tGrip;
    MoveL pStand, v500, fine, tGrip;
    SetDO doLeft, 1;
    WaitTime 0.2;
    MoveL Offs(pStand,0,0,150), v500, z10, tGrip;
    MoveJ pMiddle, v1000, fine, tGrip;
    SetDO doBrought, 1;
    WaitTime 0.1;
    SetDO doLeft, 0; ! drops the part
    SetDO doLetGo, 1;
    MoveL Offs(pMiddle,0,0,150), v500, fine, tGrip;
  ENDPROC
ENDMODULE
