! RAPID Functions, GInputDnum: a group of 32 inputs is more than a num holds.
MODULE wide_group
  PROC main()
    TPWrite ""\Dnum:=GInputDnum(giCode);    ! -> 4294967295
    TPWrite ""\Num:=GInput(giCode);
  ERROR
    TPWrite "too much "\Bool:=ERRNO=ERR_GO_LIM; ! -> too much TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
