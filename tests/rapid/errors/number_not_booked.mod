! RAPID Kernel, RAISE: a number that was never booked is ERR_ILLRAISE.
MODULE number_not_booked
  VAR errnum ERR_FORGOTTEN:=-1;

  PROC main()
    RAISE ERR_FORGOTTEN;
    TPWrite "next";                     ! -> next
  ERROR
    TPWrite "illegal "\Bool:=ERRNO=ERR_ILLRAISE; ! -> illegal TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
