! RAPID Kernel, Array elements: an index is a whole number.
MODULE index_not_whole
  VAR num arr{3}:=[1,2,3];
  VAR num half:=1.5;

  PROC main()
    arr{half}:=1;                       ! stops: an index must be an integer, not 1.5 (ERR_NOTINTVAL)
  ENDPROC
ENDMODULE
