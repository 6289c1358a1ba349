! RAPID Overview, Error recovery: TRYNEXT goes on after the statement, within its loop.
MODULE clauses_within_loops
  VAR num divisors{4}:=[2,0,4,0];

  PROC main()
    FOR i FROM 1 TO 4 DO
      TPWrite "8 : "\Num:=8/divisors{i};
      ! -> 8 : 4
      ! -> 8 : 2
    ENDFOR
    TPWrite "end";                      ! -> end
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
