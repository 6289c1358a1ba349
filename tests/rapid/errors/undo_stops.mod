! RAPID Overview, UNDO: Stop has no place in a clause that tidies up; what is left of the clauses is
! ignored.
MODULE undo_stops
  PROC main()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC

  PROC inner()
    EXIT;
  UNDO
    Stop;                               ! stops: Stop in an UNDO clause, which only tidies up
  ENDPROC
ENDMODULE
