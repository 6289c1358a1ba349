! RAPID Kernel, UNDO: also runs where a long jump goes over the routine.
MODULE undo_and_long_jump
  PROC main()
    middle;
    TPWrite "end";                        ! -> end
  ERROR (LONG_JMP_ALL_ERR)
    TPWrite "caught";                     ! -> caught
    TRYNEXT;
  ENDPROC

  PROC middle()
    deep;
  ERROR
    TPWrite "never";
    RETURN;
  UNDO
    TPWrite "undone";                     ! -> undone
  ENDPROC

  PROC deep()
    RAISE 5;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
