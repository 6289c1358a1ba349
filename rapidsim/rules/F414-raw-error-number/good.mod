MODULE example
  VAR num parts;
  PROC main()
    parts:=100/parts;
  ERROR IF ERRNO=ERR_DIVZERO TRYNEXT;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR errnum ERR_GLUE:=-1;
  VAR num parts;
  PROC main()
    BookErrNo ERR_GLUE;
    WaitTime 1/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO OR ERRNO=ERR_GLUE OR ERRNO=7 TRYNEXT;
  ENDPROC
ENDMODULE
