! RAPID Kernel, Error recovery: after four retries of a statement the error is ERR_EXCRTYMAX.
MODULE retry_too_often
  VAR num zero;
  VAR num tries;

  PROC main()
    tries:=1/zero;                      ! stops: 4 retries did not help: division by zero (ERR_EXCRTYMAX)
  ERROR
    tries:=tries+1;
    TPWrite "try "\Num:=tries;
    ! -> try 1
    ! -> try 2
    ! -> try 3
    ! -> try 4
    ! -> try 5
    RETRY;
  ENDPROC
ENDMODULE
