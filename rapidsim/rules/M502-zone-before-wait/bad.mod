MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,z50,tool0; ! found
    WaitTime 1;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  VAR signaldi ready;
  VAR num n;
  VAR socketdev line;
  VAR string answer;
  PERS wobjdata belt:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
  VAR syncident meeting;
  VAR syncident parting;
  CONST zonedata own:=[FALSE,3,5,5,0.5,5,0.5];
  PROC main()
    MoveJ p10,v500,z50,tool0;         ! found
    WaitTime 1;
    MoveJ p20,v500,own,tool0;         ! found
    n:=n+1;
    TPWrite "waiting";
    WaitDI ready,1\MaxTime:=5;
    IF n>2 THEN
      MoveL p10,v500\V:=300,fine\Z:=5,tool0;  ! found
      WaitUntil n>3\MaxTime:=2;
    ENDIF
    MoveJ p20,v500,z1,tool0;          ! found
    Stop;
    MoveJ p10,v500,z50,tool0;         ! found
    SocketReceive line\Str:=answer;
    MoveL p20,v500,z10,tool0;         ! found
    n:=UINumEntry(\Header:="Parts"\Message:="How many?"\InitValue:=1);
    MoveL p10,v500,z10,tool0;         ! found
    WaitWObj belt;
    TriggLIOs p20,v500,z10,tool0;     ! found
    ErrWrite\I,"Cell","meets the other robot";
    SyncMoveOn meeting,both;
    SyncMoveOff parting;
  ENDPROC
ENDMODULE
! ---
MODULE through_calls
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo grip;
  VAR signaldi gripped;
  VAR bool is_heavy;
  PROC main()
    MoveL p10,v300,z5,tool0;          ! found
    grip_close;
    MoveL p20,v300,z5,tool0;          ! found
    hand_over;
    MoveL p10,v300,z5,tool0;          ! found
    is_heavy:=weight()>3;
    ends_flying;
    WaitTime 1;                       ! found
    WHILE TRUE DO
      WaitDI gripped,0\MaxTime:=9;
      MoveL p10,v300,fine,tool0;
      MoveL p20,v300,z10,tool0;       ! found
    ENDWHILE
  ENDPROC
  PROC hand_over()
    IF is_heavy THEN
      AccSet 50,50;
    ENDIF
    grip_close;
  ENDPROC
  PROC grip_close()
    SetDO grip,1;
    WaitDI gripped,1\MaxTime:=2;
  ENDPROC
  FUNC num weight()
    WaitTime 0.5;
    RETURN 2;
  ENDFUNC
  PROC ends_flying()
    MoveL p20,v300,fine,tool0;
    IF is_heavy THEN
      MoveL p10,v100,z5,tool0;
    ELSE
      MoveL p10,v300,z5,tool0;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE nested
  VAR bool is_heavy;
  VAR bool is_slow;
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveL p10,v100,z10,tool0;         ! found
    IF is_heavy THEN
      WaitTime 1;
    ENDIF
    WaitTime 2;
    MoveL p10,v100,z20,tool0;         ! found
    IF is_heavy THEN
      IF is_slow THEN
        WaitTime 1;
      ENDIF
    ENDIF
    WaitTime 2;
  ENDPROC
ENDMODULE
