! RAPID Functions, DnumToNum: a number beyond the range of num is ERR_NUM_LIMIT.
MODULE beyond_num
  VAR dnum large:=1E+300;
  VAR num small;

  PROC main()
    small:=DnumToNum(large);
  ERROR
    TPWrite "limit "\Bool:=ERRNO=ERR_NUM_LIMIT;  ! -> limit TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
