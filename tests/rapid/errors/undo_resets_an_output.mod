! RAPID Overview, UNDO: what a routine has begun is put back when it is left from below.
MODULE undo_resets_an_output
  VAR bool gripping;

  PROC main()
    grip;
  ERROR (5)
    TPWrite "gripping "\Bool:=gripping;          ! -> gripping FALSE
    TRYNEXT;
  ENDPROC

  PROC grip()
    gripping:=TRUE;
    lift;
  UNDO
    gripping:=FALSE;
  ENDPROC

  PROC lift()
    RAISE 5;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
