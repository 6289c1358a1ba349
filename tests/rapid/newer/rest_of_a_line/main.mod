! RAPID Functions, ReadStr: \Status tells that a line is longer than the 80 characters of a string.
MODULE rest_of_a_line
  VAR iodev file;
  VAR string text;
  VAR string state;
  PROC main()
    Open "HOME:/long.txt",file\Write;
    FOR i FROM 1 TO 9 DO
      Write file,"0123456789"\NoNewLine;
    ENDFOR
    Write file,"";
    Close file;
    Open "HOME:/long.txt",file\Read;
    text:=ReadStr(file\Status:=state);
    TPWrite state\Num:=StrLen(text);  ! -> REMAIN80
    text:=ReadStr(file\Status:=state);  ! warning: R104
    TPWrite text+state;  ! -> 0123456789
    Close file;
  ENDPROC
ENDMODULE
