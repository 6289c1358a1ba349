! RAPID Kernel, Alias types: of records, in records, in arrays, as parameters.
MODULE aliases_of_records
  ALIAS pos corner;
  RECORD box
    corner low;
    corner high;
  ENDRECORD
  ALIAS box crate;
  VAR crate crates{2}:=[[[0,0,0],[1,1,1]],[[2,2,2],[4,4,4]]];

  PROC main()
    crates{1}.low:=crates{2}.high-crates{1}.high;
    TPWrite ValToStr(crates{1}.low);      ! -> [3,3,3]
    TPWrite ValToStr(size(crates{2}));    ! -> [2,2,2]
  ENDPROC

  FUNC pos size(box b)
    RETURN b.high-b.low;
  ENDFUNC
ENDMODULE
