! RAPID Overview, UNDO: ExitCycle ends the routines that run, so their clauses run.
MODULE undo_by_exit_cycle
  PROC main()
    work;
    TPWrite "never";
  ENDPROC

  PROC work()
    TPWrite "begins";                   ! -> begins
    ExitCycle;
  UNDO
    TPWrite "undone";                   ! -> undone
  ENDPROC
ENDMODULE
