! RAPID Instructions, StartMove: within 10 mm of where it left its path the robot goes back by itself.
MODULE regain_from_near
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
    MoveL Offs(back,5,0,7),v500,fine,tool0;
    RestoPath;
    StartMove;
    TPWrite "goes on";                  ! -> goes on
  ENDTRAP
ENDMODULE
