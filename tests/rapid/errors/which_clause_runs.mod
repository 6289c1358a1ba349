! RAPID Functions, ExecHandler: whether a routine's body, its ERROR or its UNDO clause runs.
MODULE which_clause_runs
  VAR num zero;

  PROC main()
    TPWrite "body "\Bool:=ExecHandler()=HANDLER_NONE;       ! -> body TRUE
    zero:=1/zero;
    TPWrite "again "\Bool:=ExecHandler()=HANDLER_NONE;      ! -> again TRUE
    inner;
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "clause "\Bool:=ExecHandler()=HANDLER_ERR;
    ! -> clause TRUE
    ! -> clause TRUE
    TRYNEXT;
  ENDPROC

  PROC inner()
    deep;
  UNDO
    TPWrite "undo "\Bool:=ExecHandler()=HANDLER_UNDO;       ! -> undo TRUE
  ENDPROC

  PROC deep()
    RAISE 7;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
