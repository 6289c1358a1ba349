! RAPID Instructions, MoveL: with \Conc the program goes on at once, and the robot still stops.
MODULE concurrent
  CONST robtarget p:=[[850,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;
  VAR num sixth;

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ p,v500,fine,tool0;
    ClkStart watch;
    MoveL\Conc,Offs(p,0,200,0),v100,fine,tool0;
    TPWrite "at once: "\Bool:=ClkRead(watch)<0.1;        ! -> at once: TRUE
    MoveL p,v100,fine,tool0;
    TPWrite "then waits: "\Bool:=ClkRead(watch)>4;       ! -> then waits: TRUE
    FOR i FROM 1 TO 6 DO
      sixth:=i;
      MoveL\Conc,Offs(p,0,i,0),v100,fine,tool0;
    ENDFOR
  ERROR
    IF ERRNO=ERR_CONC_MAX THEN
      TPWrite "too many: "\Num:=sixth;                   ! -> too many: 6
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
