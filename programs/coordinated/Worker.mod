MODULE Worker
  PERS tasks both{2}:=[["T_HOLDER"],["T_WORKER"]];
  VAR syncident ready;
  VAR syncident together;
  VAR syncident apart;

  TASK PERS tooldata tTorch:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,90],[1,0,0,0],0,0,0]];
  ! The plate in the hand of the other robot: its user frame is the flange of `holder`.
  TASK PERS wobjdata wPlate:=[FALSE,FALSE,"holder",[[0,0,0],[1,0,0,0]],[[0,0,50],[1,0,0,0]]];

  ! A square of 200 mm on the plate, seen from the front.
  CONST robtarget pCorner:=[[-100,-100,5],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    WaitSyncTask ready, both;
    MoveJ Offs(pCorner,0,0,100), v500, z10, tTorch\WObj:=wPlate;
    MoveL pCorner, v100, fine, tTorch\WObj:=wPlate;
    SyncMoveOn together, both;
    MoveL Offs(pCorner,200,0,0)\ID:=10, v100, z10, tTorch\WObj:=wPlate;
    MoveL Offs(pCorner,200,200,0)\ID:=20, v100, z10, tTorch\WObj:=wPlate;
    MoveL Offs(pCorner,0,200,0)\ID:=30, v100, z10, tTorch\WObj:=wPlate;
    MoveL pCorner\ID:=40, v100, fine, tTorch\WObj:=wPlate;
    SyncMoveOff apart;
    MoveL Offs(pCorner,0,0,100), v500, fine, tTorch\WObj:=wPlate;
  ENDPROC
ENDMODULE
