MODULE example
  VAR iodev log;
  PROC main()
    FOR i FROM 1 TO 3 DO
      Open "HOME:"\File:="log.txt",log\Append; ! found
      Write log,"part";
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR iodev log;
  VAR num n;
  PROC main()
    WHILE TRUE DO
      write_line "part";              ! found
      WaitTime 1;
    ENDWHILE
  ENDPROC
  PROC write_line(string text)
    Open "HOME:"\File:="log.txt",log\Append;
    Write log,text;
  ENDPROC
ENDMODULE
