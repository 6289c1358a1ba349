MODULE Holder
  ! One robot holds a plate and turns it, another runs along the edge of the plate meanwhile.
  !
  !   rapidsim run programs/coordinated/Holder.mod

  PERS tasks both{2}:=[["T_HOLDER"],["T_WORKER"]];
  VAR syncident ready;
  VAR syncident together;
  VAR syncident apart;

  TASK PERS tooldata tPlate:=[TRUE,[[0,0,50],[1,0,0,0]],[3,[0,0,50],[1,0,0,0],0,0,0.01]];

  ! The plate looks at the other robot, and a little down.
  CONST robtarget pHold:=[[750,0,900],[0.573576,0,0.819152,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ pHold, v500, fine, tPlate;
    WaitSyncTask ready, both;
    ! The worker comes to the plate, which stands still.
    SyncMoveOn together, both;
    MoveL RelTool(pHold,0,0,0\Rz:=10)\ID:=10, v100, z10, tPlate;
    MoveL Offs(RelTool(pHold,0,0,0\Rz:=20),0,60,40)\ID:=20, v100, z10, tPlate;
    MoveL Offs(RelTool(pHold,0,0,0\Rz:=30),0,0,80)\ID:=30, v100, z10, tPlate;
    MoveL pHold\ID:=40, v100, fine, tPlate;
    SyncMoveOff apart;
  ENDPROC
ENDMODULE
