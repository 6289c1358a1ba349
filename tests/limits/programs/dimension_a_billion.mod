! A dimension that no array has, counted in billions: ERR_ILLDIM at once.
MODULE dimension_a_billion
  VAR num a{3};
  VAR num k:=1E9;
  PROC main()
    VAR num n;
    n:=Dim(a,k);
  ENDPROC
ENDMODULE
