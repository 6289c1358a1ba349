! RAPID Kernel, UNDO: runs where the routine is left without coming to its end.
MODULE undo_clause
  PROC main()
    inner;
  ENDPROC

  PROC inner()
    TPWrite "opened";                     ! -> opened
    EXIT;                                 ! note: R107 ! ends: stopped
  UNDO
    TPWrite "closed";                     ! -> closed
  ENDPROC
ENDMODULE
