! RAPID Kernel, Routine declarations: each clause once.
MODULE clauses_twice
  PROC main()
  ERROR
    RETURN;
  ERROR                                   ! error: E119
    RAISE;
  ENDPROC
ENDMODULE
