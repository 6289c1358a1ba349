! RAPID Instructions, ErrRaise: without an ERROR clause the program stops, and says why.
MODULE err_raise_unhandled
  VAR errnum ERR_LOW:=-1;

  PROC main()
    BookErrNo ERR_LOW;
    ErrRaise "ERR_LOW",7055,"battery",ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_UNUSED,ERRSTR_EMPTY; ! -> warning 7055: battery
    ! stops: ERR_LOW, which ErrRaise raised: battery
  ENDPROC
ENDMODULE
