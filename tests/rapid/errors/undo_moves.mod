! RAPID Overview, UNDO: a clause that tidies up does not move the robot.
MODULE undo_moves
  PROC main()
    TPWrite ValToStr(ExecHandler()=HANDLER_UNDO);   ! -> FALSE
    EXIT;
  UNDO
    TPWrite ValToStr(ExecHandler()=HANDLER_UNDO);   ! -> TRUE
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0; ! stops: MoveAbsJ in an UNDO clause, which only tidies up
    TPWrite "never";
  ENDPROC
ENDMODULE
