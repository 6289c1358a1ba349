! RAPID Functions, StrFormat: arguments stand in the places of their numbers.
MODULE str_format
  PROC main()
    TPWrite StrFormat("{1} of {2}, {1}"\Arg1:="3"\Arg2:="8"); ! -> 3 of 8, 3
    TPWrite StrFormat("no places");         ! -> no places
    TPWrite StrFormat("{2}"\Arg1:="x");
  ERROR
    TPWrite ValToStr(ERRNO=ERR_ARGVALERR);  ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
