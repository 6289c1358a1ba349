! RAPID Kernel, Error recovery: an error in an ERROR clause ends the program, and so does EXIT.
MODULE clause_that_fails
  VAR num zero;
  VAR num list{3};

  PROC main()
    work;
  ERROR
    TRYNEXT;
  ENDPROC

  PROC work()
    zero:=1/zero;                       ! answered: ERR_DIVZERO ended the program by work
  ERROR
    list{zero+9}:=1;                    ! answered: ERR_OUTOFBND ended the program ! stops: index 9 is outside the array, which has 1 to 3 (ERR_OUTOFBND)
  ENDPROC
ENDMODULE
