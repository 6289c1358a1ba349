! RAPID Overview, Error recovery: a called routine that handles an error changes ERRNO.
MODULE a_clause_sets_another_number
  PROC main()
    VAR num zero;
    zero:=1/zero;
    TPWrite "after";          ! -> after
  ERROR
    TPWrite "divided "\Bool:=ERRNO=ERR_DIVZERO;         ! -> divided TRUE
    tell;
    TPWrite "still "\Bool:=ERRNO=ERR_DIVZERO;           ! -> still FALSE
    TRYNEXT;
  ENDPROC

  PROC tell()
    VAR string text;
    text:=StrPart("abc",5,1);
  ERROR
    TPWrite "outside "\Bool:=ERRNO=ERR_ARGVALERR;       ! -> outside TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
