MODULE stop_and_start
  ! A long move with a timer, and a door that stops it: the robot brakes on its path, moves away,
  ! comes back, and goes on. Ticks that fall due meanwhile are served afterwards.
  CONST robtarget a:=[[800,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget up:=[[800,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum door;
  VAR intnum tick;
  VAR robtarget stopped;
  VAR pos door_at;
  PROC main()
    MoveJ a,v500,fine,tool0;
    CONNECT door WITH door_open;
    ISignalDI diDoor,1,door;
    CONNECT tick WITH beat;
    ITimer 1,tick;
    MoveL b,v200,fine,tool0;
    IDelete tick;
    TPWrite "there";
    MoveL a,v200,fine,tool0;
    TPWrite "back";
  ENDPROC
  FUNC bool OnLine()
    RETURN Abs(stopped.trans.x-800)<0.001 AND Abs(stopped.trans.z-600)<0.001;
  ENDFUNC
  TRAP door_open
    door_at:=CPos();
    StopMove\Quick;
    StorePath;
    stopped:=CRobT();
    TPWrite "braked within 15 mm on the line: "\Bool:=OnLine() AND Distance(door_at,stopped.trans)<15;
    MoveL up,v200,fine,tool0;
    TPWrite "up";
    WaitDI diDoor,0;
    MoveL stopped,v200,fine,tool0;
    TPWrite "where it was stopped: "\Bool:=Distance(CPos(),stopped.trans)<0.001;
    RestoPath;
    StartMove;
  ENDTRAP
  TRAP beat
    TPWrite "tick";
  ENDTRAP
ENDMODULE
