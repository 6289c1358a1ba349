! RAPID Instructions, CONNECT: a task defines 100 interrupts at a time, and not one more.
MODULE more_than_there_are
  VAR intnum each{101};

  PROC main()
    FOR i FROM 1 TO 101 DO
      CONNECT each{i} WITH nothing;
    ENDFOR
    TPWrite "the first made room";            ! -> the first made room
  ERROR
    IF ERRNO=ERR_INOMAX THEN
      TPWrite "no more interrupts";           ! -> no more interrupts
      IDelete each{1};
      RETRY;
    ENDIF
  ENDPROC

  TRAP nothing
  ENDTRAP
ENDMODULE
