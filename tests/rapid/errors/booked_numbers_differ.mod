! RAPID Instructions, BookErrNo: each variable gets a number of its own, and keeps it.
MODULE booked_numbers_differ
  VAR errnum first:=-1;
  VAR errnum second:=-1;
  VAR errnum seen;

  PROC main()
    BookErrNo first;
    BookErrNo second;
    seen:=first;
    BookErrNo first;
    TPWrite "kept "\Bool:=first=seen;   ! -> kept TRUE
    TPWrite "differ "\Bool:=first<>second;       ! -> differ TRUE
    RAISE second;
  ERROR
    TPWrite "second "\Bool:=ERRNO=second;        ! -> second TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
