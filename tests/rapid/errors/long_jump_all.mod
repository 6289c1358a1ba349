! RAPID Kernel, Long jump: LONG_JMP_ALL_ERR stands for every number.
MODULE long_jump_all
  PROC main()
    middle;
    TPWrite "next";                     ! -> next
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "main has "\Num:=ERRNO;     ! -> main has 33
    TRYNEXT;
  ENDPROC

  PROC middle()
    deep;
  ERROR
    TPWrite "never";
    RETURN;
  ENDPROC

  PROC deep()
    RAISE 32;
  ERROR
    RAISE 33;
  ENDPROC
ENDMODULE
