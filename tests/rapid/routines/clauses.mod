! RAPID Kernel, Routine declarations: BACKWARD, ERROR and UNDO follow the statements.
MODULE clauses
  VAR num zero;

  PROC main()
    forward;
    TPWrite ValToStr(guarded());          ! -> -1
  ENDPROC

  PROC forward()                          ! note: R108
    TPWrite "forward";                    ! -> forward
  BACKWARD
    TPWrite "only when stepping back";
  ERROR
    RAISE;
  UNDO
    TPWrite "only when the pointer is taken away";
  ENDPROC

  FUNC num guarded()
    RETURN 1/zero;
  ERROR
    RETURN -1;
  UNDO
    zero:=0;
  ENDFUNC
ENDMODULE
