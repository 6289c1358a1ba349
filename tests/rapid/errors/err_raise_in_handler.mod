! RAPID Instructions, ErrRaise: in an ERROR clause the error goes on to the caller.
MODULE err_raise_in_handler
  VAR errnum ERR_LOW:=-1;

  PROC main()
    BookErrNo ERR_LOW;
    check_battery;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_LOW);        ! -> TRUE
    TRYNEXT;
  ENDPROC

  PROC check_battery()
    ErrRaise "ERR_LOW",7055,"first",ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_EMPTY; ! -> warning 7055: first
  ERROR
    ErrRaise "ERR_LOW",7056,"again",ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_EMPTY; ! -> warning 7056: again
  ENDPROC
ENDMODULE
