! RAPID Instructions, StartMove: nor does it where the tool is turned by more than 20 degrees.
MODULE regain_turned
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum service;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT service WITH on_service;
    ITimer \Single,0.5,service;
    MoveL p2,v100,fine,tool0;
  ENDPROC

  TRAP on_service
    VAR robtarget back;
    StopMove;
    StorePath;
    back:=CRobT(\Tool:=tool0);
    ConfJ \Off;
    MoveJ RelTool(back,0,0,0\Rz:=25),v500,fine,tool0;
    RestoPath;
    StartMove;                          ! stops: the robot is 0.0 mm and 25.0 deg away from where it left its path; move it back before RestoPath (ERR_PATHDIST)
  ENDTRAP
ENDMODULE
