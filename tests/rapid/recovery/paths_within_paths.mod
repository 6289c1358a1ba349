! RAPID Instructions, StorePath: a path may be stored while another is stored already.
MODULE paths_within_paths
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum service;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT service WITH on_service;
    ITimer \Single,0.5,service;
    MoveL p2,v100,fine,tool0;
    TPWrite "end "\Pos:=CPos(\Tool:=tool0);      ! -> end [700,200,600]
  ENDPROC

  TRAP on_service
    VAR robtarget back;
    StopMove;
    StorePath;
    back:=CRobT(\Tool:=tool0);
    MoveL Offs(back,0,0,100),v500,fine,tool0;
    deeper;
    TPWrite "level "\Num:=PathLevel();  ! -> level 2
    MoveL back,v500,fine,tool0;
    RestoPath;
    TPWrite "level "\Num:=PathLevel();  ! -> level 1
    StartMove;
  ENDTRAP

  PROC deeper()
    VAR robtarget back;
    StorePath;
    TPWrite "level "\Num:=PathLevel();  ! -> level 3
    back:=CRobT(\Tool:=tool0);
    MoveL Offs(back,50,0,0),v500,fine,tool0;
    MoveL back,v500,fine,tool0;
    RestoPath;
  ENDPROC
ENDMODULE
