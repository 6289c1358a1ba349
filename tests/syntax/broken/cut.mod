MODULE cut
  PROC first()
    Stop;
  ENDPROC
  PROC second()
    FOR i FROM 1 TO 3 DO
      IF i=2 THEN
        MoveL Offs(p10,0,
