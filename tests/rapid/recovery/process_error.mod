! RAPID Instructions, ProcerrRecovery: a trap makes the move under way fail; its clause goes on.
MODULE process_error
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum torch;
  VAR pos stopped;

  PROC main()
    CONNECT torch WITH on_torch;
    MoveJ p1,v500,fine,tool0;
    weld;
    TPWrite "at "\Pos:=CPos(\Tool:=tool0);       ! -> at [700,200,600]
  ENDPROC

  PROC weld()
    ITimer\Single,1,torch;
    MoveL p2,v100,fine,tool0;
    TPWrite "welded";                   ! -> welded
  ERROR
    TPWrite "path stop "\Bool:=ERRNO=ERR_PATH_STOP;            ! -> path stop TRUE
    stopped:=CPos(\Tool:=tool0);
    TPWrite "on the way "\Bool:=stopped.y>50 AND stopped.y<150;     ! -> on the way TRUE
    TPWrite "stands "\Bool:=IsStopMoveAct(\FromMoveTask);      ! -> stands TRUE
    StorePath;
    MoveL Offs(CRobT(\Tool:=tool0),0,0,20),v100,fine,tool0;
    MoveL Offs(CRobT(\Tool:=tool0),0,0,-20),v100,fine,tool0;
    RestoPath;
    StartMoveRetry;
  ENDPROC

  TRAP on_torch
    TPWrite "no gas";                   ! -> no gas
    ProcerrRecovery\SyncLastMoveInst;
    TPWrite "the trap ends first";      ! -> the trap ends first
  ENDTRAP
ENDMODULE
