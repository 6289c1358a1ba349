! RAPID Overview, Long jump: the clause that lists the number may retry what it called.
MODULE long_jump_over_retries
  CONST errnum ERR_JAM:=44;
  VAR num calls;

  PROC main()
    outer;
    TPWrite "calls "\Num:=calls;        ! -> calls 2
  ERROR (ERR_JAM)
    TPWrite "again";                    ! -> again
    RETRY;
  ENDPROC

  PROC outer()
    inner;
  ENDPROC

  PROC inner()
    Incr calls;
    IF calls=1 RAISE ERR_JAM;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
