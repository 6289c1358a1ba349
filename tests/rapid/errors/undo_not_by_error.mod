! RAPID Overview, UNDO: a program that an error stops is still in its routines.
MODULE undo_not_by_error
  PROC main()
    inner;
  UNDO
    TPWrite "never";
  ENDPROC

  PROC inner()
    VAR num fast:=0;
    VelSet fast,100;                    ! stops: VelSet 0,100: both must be greater than 0
  UNDO
    TPWrite "never";
  ENDPROC
ENDMODULE
