! RAPID Overview, UNDO: a program that stops is still in its routines, and may go on in them.
MODULE undo_not_by_stop
  PROC main()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC

  PROC inner()
    Stop;                               ! ends: stopped
    ! note: R107
  UNDO
    TPWrite "never";
    WaitTime 1;
  ENDPROC
ENDMODULE
