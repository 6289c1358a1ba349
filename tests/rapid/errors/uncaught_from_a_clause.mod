! RAPID Kernel, RAISE: another number than the one there was is raised where the clause says so.
MODULE uncaught_from_a_clause
  CONST errnum ERR_OWN:=12;
  VAR num zero;

  PROC main()
    compute;
  ENDPROC

  PROC compute()
    zero:=1/zero;
  ERROR
    TPWrite "translated";               ! -> translated
    RAISE ERR_OWN;                      ! stops: the program raised error ERR_OWN
  ENDPROC
ENDMODULE
