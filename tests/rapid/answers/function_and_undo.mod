! RAPID Overview, Error recovery: errors of functions, of UNDO clauses' routines, of long jumps.
MODULE function_and_undo
  VAR num zero;
  CONST errnum ERR_DEEP:=20;

  PROC main()
    TPWrite "got "\Num:=safe();         ! -> got -1
    middle;
    TPWrite "end";                      ! -> end
  ERROR (ERR_DEEP)
    TRYNEXT;
  ENDPROC

  FUNC num safe()
    RETURN 1/zero;                      ! answered: ERR_DIVZERO returned by safe
  ERROR
    RETURN -1;
  ENDFUNC

  PROC middle()
    deep;
  ERROR
    TPWrite "never";
    TRYNEXT;
  UNDO
    TPWrite "undone";                   ! -> undone
  ENDPROC

  PROC deep()
    RAISE ERR_DEEP;
    ! answered: ERR_DEEP raised by deep ! answered: ERR_DEEP next by main
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
