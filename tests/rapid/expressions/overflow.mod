! RAPID Kernel, Data type num: a result beyond the largest number is an error.
MODULE overflow
  VAR num large:=3E38;

  PROC main()
    TPWrite ValToStr(large);              ! -> 3E+38
    large:=large*10;                      ! stops: the result 3E+39 is too large (ERR_OVERFLOW)
  ENDPROC
ENDMODULE
