MODULE roundsWithoutNumber
  ! Bounds of a loop that are infinite, or no number at all, count no elements of an array.
  VAR num row{3};
  PROC main()
    FOR i FROM 1 TO 1E38*1E38 DO
      row{i}:=1;
    ENDFOR
    FOR i FROM 1E38*1E38-1E38*1E38 TO 3 STEP 1E38 DO
      row{i}:=1;
    ENDFOR
    FOR i FROM 1E38 TO 1E38*1E38 STEP 1 DO
      row{i}:=1;
    ENDFOR
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
