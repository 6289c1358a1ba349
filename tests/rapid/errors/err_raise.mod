! RAPID Instructions, ErrRaise: a message in the log, and the error that BookErrNo has booked.
MODULE err_raise
  VAR errnum ERR_LOW:=-1;

  PROC main()
    BookErrNo ERR_LOW;
    check_battery;
    TPWrite "went on";                      ! -> went on
  ERROR
    TPWrite ValToStr(ERRNO=ERR_LOW);        ! -> TRUE
    TRYNEXT;
  ENDPROC

  PROC check_battery()
    ErrRaise "ERR_LOW",7055,"battery","12 V",ERRSTR_TASK,ERRSTR_UNUSED,ERRSTR_EMPTY; ! -> warning 7055: battery / 12 V / T_ROB1
  ENDPROC
ENDMODULE
