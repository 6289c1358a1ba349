MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    WaitTime 1;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR socketdev line;
  VAR num parts;
  PROC main()
    MoveJ p10,v500,z50,tool0;
    WaitTime 0;
    MoveJ p20,v500,z50\Inpos:=inpos50,tool0;
    WaitTime 1;
    MoveJ p10,v500,fine,tool0;
    WaitTime 1;
    MoveL p10,v500,z50\Z:=0,tool0;
    WaitTime 1;
    MoveJ p20,v500,z50,tool0;
    parts:=SocketPeek(line);
    MoveL p10,v500,z50,tool0;
    lower_when_free;
    perhaps parts;
    on_the_way;
    MoveL p20,v500,fine,tool0;
    WaitTime 1;
  ENDPROC
  PROC lower_when_free()
    ! The next move comes first, and waits happen only if something is wrong.
    IF parts<0 Stop;
    MoveL p20,v500,z10,tool0;
  ENDPROC
  PROC perhaps(num n)
    TEST n
    CASE 1:
      WaitTime 1;
    DEFAULT:
      TPWrite "on";
    ENDTEST
    WHILE parts>3 DO
      parts:=parts-1;
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
  PROC on_the_way()
    ConfL\Off;
    MoveL p10,v500,z50,tool0;
    ConfL\On;
  ENDPROC
ENDMODULE
