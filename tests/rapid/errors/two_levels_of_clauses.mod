! RAPID Overview, Error recovery: what the inner clause does not know the outer one gets.
MODULE two_levels_of_clauses
  PROC main()
    outer 1;
    outer 2;
    outer 3;
  ERROR
    TPWrite "main "\Num:=ERRNO;         ! -> main 3
    TRYNEXT;
  ENDPROC

  PROC outer(num code)
    inner code;
    TPWrite "outer goes on";
    ! -> outer goes on
    ! -> outer goes on
  ERROR
    IF ERRNO=2 TRYNEXT;
    RAISE;
  ENDPROC

  PROC inner(num code)
    RAISE code;
  ERROR
    IF ERRNO=1 TRYNEXT;
    RAISE;
  ENDPROC
ENDMODULE
