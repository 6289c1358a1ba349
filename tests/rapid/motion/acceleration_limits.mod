! RAPID Instructions, PathAccLim: the TCP gathers speed no faster than the program allows.
MODULE acceleration_limits
  CONST robtarget p:=[[850,-200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    PathAccLim TRUE\AccMax:=1,TRUE\DecelMax:=1;
    ! 0.4 s up to 400 mm/s, 0.4 s down, and 240 mm between at 400 mm/s: 1.4 s, and the smoothing.
    TPWrite "along the path: "\Bool:=Abs(took()-1.4)<0.11;   ! -> along the path: TRUE
    PathAccLim FALSE,FALSE;
    WorldAccLim \On:=0.5;
    TPWrite "in the world: "\Bool:=took()>1.7;               ! -> in the world: TRUE
    WorldAccLim \Off;
    TPWrite "without: "\Bool:=took()<1.3;                    ! -> without: TRUE
    PathAccLim TRUE\AccMax:=0.01,FALSE;
  ERROR
    IF ERRNO=ERR_ACC_TOO_LOW THEN
      TPWrite "too low";                                     ! -> too low
      TRYNEXT;
    ENDIF
  ENDPROC

  FUNC num took()
    VAR clock watch;
    MoveL p,v1000,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(p,0,400,0),v400,fine,tool0;
    ClkStop watch;
    RETURN ClkRead(watch);
  ENDFUNC
ENDMODULE
