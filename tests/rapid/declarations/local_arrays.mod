! RAPID Kernel, Scope rules: LOCAL stands before arrays as before any data.
MODULE local_arrays
  LOCAL VAR num list{3};
  LOCAL CONST num table{2,2}:=[[1,2],[3,4]];

  PROC main()
    list{3}:=table{2,2};
    TPWrite ValToStr(list);             ! -> [0,0,4]
  ENDPROC
ENDMODULE
