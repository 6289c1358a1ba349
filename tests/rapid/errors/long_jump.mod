! RAPID Kernel, Long jump: ERROR with a list catches what RAISE sends on from deeper down.
MODULE long_jump
  CONST errnum ERR_PICK:=20;
  CONST errnum ERR_PLACE:=21;

  PROC main()
    middle;
    TPWrite "next";                     ! -> next
  ERROR (ERR_PICK,ERR_PLACE)
    TPWrite "main has "\Num:=ERRNO;     ! -> main has 20
    TRYNEXT;
  ENDPROC

  PROC middle()
    deep;
    TPWrite "never";
  ERROR
    TPWrite "never, the jump goes over this clause";
    TRYNEXT;
  ENDPROC

  PROC deep()
    RAISE ERR_PICK;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
