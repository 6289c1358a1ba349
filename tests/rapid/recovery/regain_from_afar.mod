! RAPID Instructions, StartMove: farther than 10 mm off its path the robot does not go on.
MODULE regain_from_afar
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum service;
  VAR robtarget back;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT service WITH on_service;
    ITimer \Single,0.5,service;
    MoveL p2,v100,fine,tool0;
    TPWrite "end "\Pos:=CPos(\Tool:=tool0);      ! -> end [700,200,600]
  ENDPROC

  TRAP on_service
    StopMove;
    StorePath;
    back:=CRobT(\Tool:=tool0);
    MoveL Offs(back,0,0,12),v500,fine,tool0;
    RestoPath;
    go_on;
  ENDTRAP

  PROC go_on()
    StartMove;
  ERROR
    IF ERRNO=ERR_PATHDIST THEN
      TPWrite "too far";                ! -> too far
      StorePath;
      MoveL back,v500,fine,tool0;
      RestoPath;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
