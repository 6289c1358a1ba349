! RAPID Instructions, MoveL: \T is the time of the whole move, whatever the speed says.
MODULE programmed_time
  CONST robtarget p:=[[850,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;

  PROC main()
    MoveJ p,v500,fine,tool0;
    VelSet 10,100;
    ClkStart watch;
    MoveL Offs(p,0,200,0),v1000\T:=3,fine,tool0;
    ClkStop watch;
    TPWrite "about 3 s: "\Bool:=Abs(ClkRead(watch)-3)<0.25;   ! -> about 3 s: TRUE
    MoveL p,v1000\T:=0.1,fine,tool0;   ! warning: K612
  ENDPROC
ENDMODULE
