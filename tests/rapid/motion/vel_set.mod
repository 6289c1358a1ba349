! RAPID Instructions, VelSet: half the speed takes twice the time; the second value is a limit.
MODULE vel_set
  CONST robtarget p:=[[850,-200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num full;
  VAR num half;
  VAR num limited;

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    full:=took();
    VelSet 50,5000;
    half:=took();
    VelSet 100,50;
    limited:=took();
    TPWrite "half: "\Bool:=Abs(half-full-2)<0.05;        ! -> half: TRUE
    TPWrite "limited: "\Bool:=Abs(limited-half-4)<0.05;  ! -> limited: TRUE
  ENDPROC

  FUNC num took()
    VAR clock watch;
    MoveL p,v1000,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(p,0,400,0),v200,fine,tool0;
    ClkStop watch;
    RETURN ClkRead(watch);
  ENDFUNC
ENDMODULE
