MODULE example
  VAR iodev log;
  PROC main()
    FOR i FROM 1 TO 3 DO
      Open "HOME:"\File:="log.txt",log\Append;
      Write log,"part";
      Close log;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR iodev log;
  VAR bool is_open;
  PROC main()
    Open "HOME:"\File:="log.txt",log\Append;
    FOR i FROM 1 TO 3 DO
      Write log,"part";
    ENDFOR
    Close log;
    WHILE TRUE DO
      write_line "part";
      WaitTime 1;
    ENDWHILE
  ENDPROC
  PROC write_line(string text)
    IF NOT is_open THEN
      Open "HOME:"\File:="log.txt",log\Append;
      is_open:=TRUE;
    ENDIF
    Write log,text;
  ENDPROC
  PROC until_it_is_there()
    WHILE TRUE DO
      Open "HOME:"\File:="log.txt",log\Read;
      RETURN;
    ENDWHILE
  ENDPROC
  PROC in_two_steps()
    FOR i FROM 1 TO 3 DO
      Open "HOME:"\File:="log.txt",log\Append;
      finish;
    ENDFOR
  ENDPROC
  PROC finish()
    Close log;
  ENDPROC
ENDMODULE
