! RAPID Kernel, EXIT: ends the program, however deep in calls, past any ERROR clause.
MODULE exit_statement
  PROC main()
    inner;
    TPWrite "never";
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC

  PROC inner()
    TPWrite "going";                  ! -> going
    EXIT;                             ! note: R107 ! ends: stopped
  ENDPROC
ENDMODULE
