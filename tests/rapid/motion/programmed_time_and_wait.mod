! RAPID Instructions, MoveL: looking at the time after a move with \T does not make it late.
MODULE programmed_time_and_wait
  CONST robtarget p:=[[850,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,0,200,0),v1000\T:=2,z20,tool0;
    MoveL Offs(p,-100,200,0),v100,z20,tool0;
    ClkStart watch;
    WaitTime 0.5;
    MoveL p,v100,fine,tool0;
    TPWrite "on time";        ! -> on time
  ENDPROC
ENDMODULE
