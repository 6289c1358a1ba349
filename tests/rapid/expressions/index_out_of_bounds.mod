! RAPID Kernel, Array elements: an index beyond the array is the error ERR_OUTOFBND.
MODULE index_out_of_bounds
  VAR num arr{3}:=[1,2,3];
  VAR num i:=3;

  PROC main()
    arr{i}:=30;
    i:=i+1;
    arr{i}:=40;                         ! stops: index 4 is outside the array, which has 1 to 3 (ERR_OUTOFBND)
  ENDPROC
ENDMODULE
