! RAPID Overview, UNDO: EXIT runs the clauses of all routines that it ends, the innermost first.
MODULE undo_by_exit
  PROC main()
    outer;
  UNDO
    TPWrite "main";                     ! -> main
  ENDPROC

  PROC outer()
    inner;
  UNDO
    TPWrite "outer";                    ! -> outer
  ENDPROC

  PROC inner()
    EXIT;                               ! ends: stopped
    ! note: R107
  UNDO
    TPWrite "inner";                    ! -> inner
  ENDPROC
ENDMODULE
