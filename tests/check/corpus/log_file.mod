MODULE log_file(NOSTEPIN)
  LOCAL VAR iodev logfile;
  PERS string log_name:="HOME:/log.txt";
  PROC Log(string text\switch newfile)
    VAR num tries:=0;
    IF Present(newfile) THEN
      Open log_name,logfile\Write;
    ELSE
      Open log_name,logfile\Append;
    ENDIF
    Write logfile,CDate()+";"+CTime()+";"\NoNewLine;
    Write logfile,text;
    Close logfile;
  ERROR
    IF ERRNO=ERR_FILEOPEN THEN
      tries:=tries+1;
      WaitTime 0.1;
      IF tries<=3 THEN
        RETRY;
      ENDIF
      TRYNEXT;
    ENDIF
  UNDO
    Close logfile;
  ENDPROC
ENDMODULE
