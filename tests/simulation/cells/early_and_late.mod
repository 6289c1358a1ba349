MODULE early_and_late
  ! diEarly is there before the robot reaches the zone: the corner is kept. diLate comes when it has
  ! reached the point: the corner has become a stop.
  ! The robot stands at c from about 3.6 s: 500 mm from a, less 14 mm cut off the corner at b, are
  ! 2.4 s at 200 mm/s, and a ramp at either end. It goes on at 6 s, when diLate comes.
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL b,v200,z50,tool0;
    WaitDI diEarly,1;
    MoveL c,v200,z50,tool0;
    WaitDI diLate,1;
    MoveL b,v200,fine,tool0;
  ENDPROC
ENDMODULE
