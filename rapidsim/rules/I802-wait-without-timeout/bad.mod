MODULE example
  VAR signaldi part_there;
  PROC main()
    WaitDI part_there,1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR signaldi part_there;
  VAR signalgi part_number;
  PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
  VAR syncident meeting;
  VAR syncident parting;
  PROC main()
    WaitDI part_there,1;                       ! found
    WaitUntil\InPos,part_there=0;             ! found
    WaitGI part_number,3;                      ! found
    SyncMoveOn meeting,both;                   ! found
    SyncMoveOff parting\TimeOut:=9;
  ENDPROC
ENDMODULE
