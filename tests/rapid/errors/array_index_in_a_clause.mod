! RAPID Overview, Error recovery: an index out of bounds has a number that a clause may ask for.
MODULE array_index_in_a_clause
  VAR num list{3}:=[1,2,3];
  VAR num at:=4;

  PROC main()
    TPWrite "element "\Num:=list{at};   ! -> element 3
  ERROR
    IF ERRNO=ERR_ARRAY_SIZE OR TRUE THEN
      at:=3;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
