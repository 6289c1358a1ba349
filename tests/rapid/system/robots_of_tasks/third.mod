! RAPID Functions, RobName: a task without a robot has no name for one.
MODULE third
  PROC main()
    TPWrite "["+RobName()+"]"\Num:=MotionPlannerNo();    ! -> []0
  ENDPROC
ENDMODULE
