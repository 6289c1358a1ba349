! RAPID Overview, CONTINUE: a procedure of that name hides it, as on controllers before RobotWare 7.
MODULE continue_of_the_program
  PROC main()
    CONTINUE;
    TPWrite "behind";                       ! -> behind
  ENDPROC

  PROC continue()
    TPWrite "mine";                         ! -> mine
  ENDPROC
ENDMODULE
