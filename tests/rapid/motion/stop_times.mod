! RAPID Instructions, stoppointdata: a stop point may last, with the program waiting or not.
MODULE stop_times
  CONST robtarget p:=[[850,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST stoppointdata pause:=[2,TRUE,[0,0,0,0],0.5,0,"",0,0];
  VAR num plain;
  VAR num paused;
  VAR num ahead;
  VAR num way;

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ p,v500,fine,tool0;
    ! Once before, for the robot goes on sooner where it has not moved.
    plain:=took(inpos50);
    plain:=took(inpos50);
    paused:=took(pause);
    ! The predefined times let the program go on; only the robot's next move waits.
    ahead:=took(stoptime0_5);
    TPWrite "waits: "\Bool:=Abs(paused-plain-0.5)<0.01;   ! -> waits: TRUE
    TPWrite "goes on: "\Bool:=Abs(ahead-plain)<0.01;      ! -> goes on: TRUE
  ENDPROC

  FUNC num took(stoppointdata stop_point)
    VAR clock watch;
    MoveL p,v1000,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(p,0,200,0),v200,z50\Inpos:=stop_point,tool0;
    ClkStop watch;
    RETURN ClkRead(watch);
  ENDFUNC
ENDMODULE
