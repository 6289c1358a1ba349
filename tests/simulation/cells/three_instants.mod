MODULE three_instants
  ! One output each way, for the same fly-by point b on a path of 300 mm each side at 200 mm/s.
  ! doProgram: when the robot starts towards b, because the program runs ahead.
  ! doPlace: 50 mm before b along the line, 0.25 s before the other.
  ! doCorner: in the middle of the corner path at b, which is b itself here: a, b and c are in line.
  ! So doPlace comes 250 mm and doCorner 300 mm after the start, 1.25 s and 1.5 s at full speed, and
  ! 0.05 s later for the ramp; doAhead shows the start of the second run.
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata near;
  PROC main()
    MoveJ a,v500,fine,tool0;
    TriggIO near,50\DOp:=doPlace,1;
    TriggL b,v200,near,z50,tool0;
    SetDO doProgram,1;
    MoveL c,v200,fine,tool0;
    MoveJ a,v500,fine,tool0;
    MoveLDO b,v200,z50,tool0,doCorner,1;
    SetDO doAhead,1;
    MoveL c,v200,fine,tool0;
  ENDPROC
ENDMODULE
