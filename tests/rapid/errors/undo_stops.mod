! RAPID Overview, UNDO: Stop has no place in a clause that tidies up; the clauses further out still run.
MODULE undo_stops
  PROC main()
    inner;
  UNDO
    TPWrite "main undone";              ! -> main undone
  ENDPROC

  PROC inner()
    EXIT;
  UNDO
    Stop;                               ! stops: Stop in an UNDO clause, which only tidies up
  ENDPROC
ENDMODULE
