! RAPID Functions, RobName: the second robot is not called as the first.
MODULE second
  PROC main()
    TPWrite "["+RobName()+"]"\Num:=MotionPlannerNo();    ! -> [ROB_2]2
    TPWrite GetMecUnitName(ROB_ID);                       ! -> ROB_2
  ENDPROC
ENDMODULE
