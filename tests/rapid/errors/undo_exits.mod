! RAPID Overview, UNDO: EXIT in a clause ends the clauses; those further out are left out.
MODULE undo_exits
  PROC main()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC

  PROC inner()
    EXIT;
  UNDO
    TPWrite "inner";                    ! -> inner
    EXIT;                               ! ends: stopped
    ! note: R107
  ENDPROC
ENDMODULE
