! RAPID Overview, UNDO: nothing answers an error in an UNDO clause, which has no business with RAISE.
MODULE undo_fails
  PROC main()
    work;
  ERROR
    TPWrite "never, it is not an error of work";
    TRYNEXT;
  ENDPROC

  PROC work()
    EXIT;
  UNDO
    TPWrite "undoes";                   ! -> undoes
    RAISE 5;                            ! stops: the program raised error 5
  ENDPROC
ENDMODULE
