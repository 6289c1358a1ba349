! RAPID Overview, error recovery: an error that nobody answers ends the task, and with it the run.
MODULE second
  PERS num parts:=1;
  VAR num each;

  PROC main()
    TPWrite ValToStr(10/parts);         ! -> 10
    WaitUntil parts<>1;
    each:=10/parts;                     ! stops: division by zero (ERR_DIVZERO)
  ENDPROC
ENDMODULE
