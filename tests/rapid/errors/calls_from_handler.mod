! RAPID Kernel, Error recovery: routines called from an ERROR clause have clauses of their own.
MODULE calls_from_handler
  VAR num zero;

  PROC main()
    RAISE 1;
    TPWrite "back";                     ! -> back
  ERROR
    tidy_up;
    TPWrite "still "\Num:=ERRNO;        ! -> still 1
    TRYNEXT;
  ENDPROC

  PROC tidy_up()
    TPWrite "tidied";                   ! -> tidied
  ENDPROC
ENDMODULE
