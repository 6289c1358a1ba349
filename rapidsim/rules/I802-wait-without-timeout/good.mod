MODULE example
  VAR signaldi part_there;
  PROC main()
    WaitDI part_there,1\MaxTime:=30;
  ERROR IF ERRNO=ERR_WAIT_MAXTIME THEN
      TPWrite "No part within 30 s";
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR signaldi part_there;
  VAR bool late;
  VAR clock watch;
  VAR num number;
  VAR socketdev line;
  VAR string answer;
  PROC main()
    WaitTime 2;
    WaitDI part_there,1\MaxTime:=30\TimeFlag:=late;
    WaitUntil late\MaxTime:=3;
    WaitUntil late OR ClkRead(watch)>5;
    may_wait\seconds:=3;
    ! A person is asked, and a socket waits no longer than 60 s.
    TPReadNum number,"How many?";
    SocketReceive line\Str:=answer;
  ENDPROC
  PROC may_wait(\num seconds)
    WaitDI part_there,1\MaxTime?seconds;
  ENDPROC
ENDMODULE
