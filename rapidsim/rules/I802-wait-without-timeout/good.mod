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
  PROC main()
    WaitTime 2;
    WaitDI part_there,1\MaxTime:=30\TimeFlag:=late;
    WaitUntil late\MaxTime:=3;
    may_wait\seconds:=3;
  ENDPROC
  PROC may_wait(\num seconds)
    WaitDI part_there,1\MaxTime?seconds;
  ENDPROC
ENDMODULE
