! RAPID Overview, UNDO: a program that waits in vain goes on waiting; its place is that of the wait.
MODULE undo_not_by_endless_wait
  VAR bool ready;

  PROC main()
    WHILE NOT ready DO                  ! stops: the program loops forever here: nothing that it reads ever changes
    ENDWHILE
  UNDO
    WaitTime 1;
    TPWrite "never";
  ENDPROC
ENDMODULE
