! RAPID Overview, Positioning during program execution: the larger the zone, the shorter the way.
MODULE rectangle_zones
  CONST robtarget corner:=[[700,-150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;
  VAR num last:=1000;
  VAR num slower:=0;

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ corner,v500,fine,tool0;
    around "fine",fine;
    around "z0",z0;
    around "z1",z1;
    around "z5",z5;
    around "z10",z10;
    around "z15",z15;
    around "z20",z20;
    around "z30",z30;
    around "z40",z40;
    around "z50",z50;
    around "z60",z60;
    around "z80",z80;
    around "z100",z100;
    around "z150",z150;
    around "z200",z200;
    TPWrite "slower with a larger zone: "\Num:=slower;   ! -> slower with a larger zone: 0
  ENDPROC

  PROC around(string name,zonedata zone)
    VAR num took;
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(corner,250,0,0),v500,zone,tool0;
    MoveL Offs(corner,250,300,0),v500,zone,tool0;
    MoveL Offs(corner,0,300,0),v500,zone,tool0;
    MoveL corner,v500,fine,tool0;
    ClkStop watch;
    took:=ClkRead(watch);
    IF took>last+0.001 THEN
      Incr slower;
    ENDIF
    last:=took;
  ENDPROC
ENDMODULE
