MODULE example
  VAR intnum part_seen;
  PROC main()
    CONNECT part_seen WITH count;
    ITimer 1,part_seen;
    FOR i FROM 1 TO 3 DO
      WaitTime 2;
    ENDFOR
    IDelete part_seen;
  ENDPROC
  TRAP count
    TPWrite "part";
  ENDTRAP
ENDMODULE
! ---
MODULE near_miss
  VAR intnum ticked;
  VAR intnum ticks{3};
  PROC main()
    FOR i FROM 1 TO 3 DO
      IDelete ticked;
      CONNECT ticked WITH tick;
      ITimer 1,ticked;
    ENDFOR
    FOR i FROM 1 TO 3 DO
      CONNECT ticks{i} WITH tick;
    ENDFOR
    WaitTime 5;
  ENDPROC
  TRAP tick
    TPWrite "tick";
  ENDTRAP
  TRAP hold
    StopMove;
    StorePath;
    WaitTime 1;
    RestoPath;
    StartMove;
  ENDTRAP
ENDMODULE
