MODULE example
  CONST robtarget pPick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[600,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS loaddata part:=[2.5,[0,0,50],[1,0,0,0],0,0,0];
  PROC main()
    MoveJ Offs(pPick,0,0,50),v500,fine,tool0;
    SetDO doGrip,1; ! found
    WaitDI diGripped,1\MaxTime:=2;
    MoveL pPick,v100,fine,tool0;
    GripLoad part;
    MoveL Offs(pPick,0,0,50),v100,z10,tool0;
    MoveL pPlace,v100,fine,tool0;
    SetDO doGrip,0;
    WaitDI diGripped,0\MaxTime:=2;
    GripLoad load0;
    MoveL Offs(pPlace,0,0,50),v100,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE example
  CONST robtarget pPick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[600,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS loaddata part:=[2.5,[0,0,50],[1,0,0,0],0,0,0];
  PROC main()
    MoveJ Offs(pPick,0,0,50),v500,z10,tool0;
    MoveL pPick,v100,fine,tool0;
    SetDO doGrip,1;
    WaitDI diGripped,1\MaxTime:=2;
    GripLoad part;
    MoveL Offs(pPick,0,0,50),v100,z10,tool0;
    MoveL Offs(pPlace,0,0,50),v100,fine,tool0;
    SetDO doGrip,0; ! found
    WaitDI diGripped,0\MaxTime:=2;
    GripLoad load0;
    MoveL pPlace,v100,fine,tool0;
    MoveL Offs(pPlace,0,0,50),v100,fine,tool0;
  ENDPROC
ENDMODULE
