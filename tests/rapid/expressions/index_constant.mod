! RAPID Kernel, Array elements: a constant index beyond the array is seen without running.
MODULE index_constant
  VAR num arr{3}:=[1,2,3];

  PROC main()
    TPWrite "running";                  ! -> running
    arr{4}:=1;                          ! warning: T306 ! stops: index 4 is outside the array, which has 1 to 3 (ERR_OUTOFBND)
  ENDPROC
ENDMODULE
