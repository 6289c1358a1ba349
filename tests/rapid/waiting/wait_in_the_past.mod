! RAPID Instructions, WaitTime: a time below 0 is an argument that cannot be.
MODULE wait_in_the_past
  PROC main()
    WaitTime -1;
    TPWrite "next";                     ! -> next
  ERROR
    TPWrite "argument "\Bool:=ERRNO=ERR_ARGVALERR;          ! -> argument TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
