MODULE world_zone
  ! The lamp is on while the TCP is between y = 0 and y = 100; the guard stops the robot at y = 200.
  ! From y = -200 that is 200 mm and twice 100 mm more: at 200 mm/s 1 s and twice 0.5 s, and 0.05 s
  ! for the ramp at the start.
  CONST robtarget a:=[[800,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR shapedata middle;
  VAR shapedata far;
  VAR wztemporary lamp;
  VAR wztemporary guard;
  PROC main()
    MoveJ a,v500,fine,tool0;
    WZBoxDef \Inside,middle,[700,0,500],[900,100,700];
    WZDOSet \Temp,lamp \Inside,middle,doLamp,1;
    WZCylDef \Outside,far,[800,-200,500],400,200;
    WZLimSup \Temp,guard,far;
    MoveL b,v200,fine,tool0;
    TPWrite "never said";
  ENDPROC
ENDMODULE
