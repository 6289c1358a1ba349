MODULE stop_between
  ! A trigger before c stops the robot in the middle of a row of fly-by moves, for a second. The
  ! program has run ahead; doY still comes when the robot starts its way to e.
  ! The trigger is 160 mm after b, 0.8 s after doX, for that comes in the middle of the corner at b;
  ! braking takes 0.1 s beside the second of waiting.
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget d:=[[800,200,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget e:=[[800,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum here;
  VAR triggdata one;
  VAR robtarget p;
  PROC main()
    MoveJ a,v500,fine,tool0;
    CONNECT here WITH again;
    TriggInt one,40,here;
    MoveL b,v200,z50,tool0;
    TriggL c,v200,one,z50,tool0;
    SetDO doX,1;
    MoveL d,v200,z50,tool0;
    MoveL e,v200,z50,tool0;
    SetDO doY,1;
    SearchL diX,p,b,v100,tool0;
    TPWrite "done";
  ERROR
    TPWrite "nothing found";
    TRYNEXT;
  ENDPROC
  TRAP again
    TPWrite "stop";
    StopMove\Quick;
    WaitTime 1;
    TPWrite "start";
    StartMove;
  ENDTRAP
ENDMODULE
