! RAPID Instructions, ClearPath: after RestoPath it forgets the path that StorePath kept.
MODULE clear_what_was_stored
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum service;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT service WITH on_service;
    ITimer \Single,0.5,service;
    MoveL p2,v100,fine,tool0;
    TPWrite "at "\Pos:=here();       ! -> at [700,0,700]
    MoveL p2,v500,fine,tool0;
    TPWrite "at "\Pos:=here();       ! -> at [700,200,600]
  ENDPROC

  TRAP on_service
    StopMove;
    StorePath;
    MoveL Offs(p1,0,0,100),v500,fine,tool0;
    RestoPath;
    ClearPath;
    StartMove;
  ENDTRAP
  FUNC pos here()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN [Round(now.x),Round(Abs(now.y)),Round(now.z)];
  ENDFUNC
ENDMODULE
