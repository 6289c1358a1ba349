! RAPID Kernel, Error recovery: RETRY executes the statement that failed again.
MODULE retry_statement
  VAR num divisor;

  PROC main()
    TPWrite ValToStr(12/divisor);       ! -> 4
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      divisor:=3;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
