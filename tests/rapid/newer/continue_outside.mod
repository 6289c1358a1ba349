! RAPID Overview, CONTINUE: without a loop around it there is no next turn.
MODULE continue_outside
  PROC main()
    CONTINUE;                               ! error: F419
  ENDPROC
ENDMODULE
