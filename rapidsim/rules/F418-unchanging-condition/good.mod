MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num layer;
  PROC main()
    layer:=1;
    WHILE layer<=3 DO
      MoveJ Offs(p10,0,0,50*layer),v500,fine,tool0;
      layer:=layer+1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR intnum pressed;
  VAR signaldi button;
  VAR bool held;
  VAR bool for_ever:=TRUE;
  VAR num count;
  VAR num tries;
  VAR clock watch;
  PERS bool go:=FALSE;
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI button,1,pressed;
    held:=FALSE;
    WaitUntil held;
    WHILE held DO
      WaitTime 1;
    ENDWHILE
    WHILE count<3 DO
      count_up;
    ENDWHILE
    WHILE go=FALSE AND tries<3 DO
      WaitTime 1;
    ENDWHILE
    tries:=1;
    WHILE tries<9 DO
      WaitTime 1;
      IF go RETURN;
    ENDWHILE
    WHILE ClkRead(watch)<tries DO
      WaitTime 1;
    ENDWHILE
    WHILE next(tries) DO
      WaitTime 1;
    ENDWHILE
    tries:=0;
    WHILE tries=0 DO
      WaitTime 1000;
    ENDWHILE
    WHILE for_ever DO
      WaitTime 1;
    ENDWHILE
  ENDPROC
  PROC count_up()
    Incr count;
  ENDPROC
  FUNC bool next(INOUT num n)
    n:=n-1;
    RETURN n>0;
  ENDFUNC
  TRAP hold
    held:=TRUE;
    Reset_it;
  ENDTRAP
  PROC Reset_it()
    tries:=0;
    IF tries>3 held:=FALSE;
  ENDPROC
ENDMODULE
! ---
MODULE parts
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num job:=0;
  PERS num parts:=5;
  PERS bool run:=TRUE;
  PROC main()
    WHILE job<1 DO
      WaitTime 0.1;
    ENDWHILE
    WHILE run DO
      MoveJ p10,v500,fine,tool0;
    ENDWHILE
    WHILE parts>0 DO
      MoveJ p10,v500,fine,tool0;
      take_one;
    ENDWHILE
  ENDPROC
  PROC take_one()
    Decr parts;
  ENDPROC
ENDMODULE
