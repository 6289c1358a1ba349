! RAPID Functions, Dim: an array has no more dimensions than it was declared with.
MODULE dimension_that_is_not_there
  VAR num grid{2,3};

  PROC main()
    FOR i FROM 1 TO 3 DO
      TPWrite "size "\Num:=Dim(grid,i);
      ! -> size 2
      ! -> size 3
    ENDFOR
  ERROR
    TPWrite "no third "\Bool:=ERRNO=ERR_ILLDIM;         ! -> no third TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
