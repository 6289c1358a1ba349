MODULE circle
  CONST robtarget c:=[[650,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num r:=40;
  PROC main()
    VAR num a:=0;
    MoveJ Offs(c,r,0,0),v200,fine,tool0;
    MoveC Offs(c,0,r,0),Offs(c,-r,0,0),v100,z1,tool0;
    MoveC Offs(c,0,-r,0),
          Offs(c,r,0,0),
          v100,
          fine,
          tool0;
    WHILE a<=360 DO
      MoveL Offs(c,r*Cos(a),r*Sin(a),0),v100,z1,tool0;
      a:=a+30;
    ENDWHILE
    MoveL c,v100,fine,tool0;
  ENDPROC
ENDMODULE
