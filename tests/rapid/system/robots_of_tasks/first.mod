! RAPID Functions, RobName: each task of a robot has one of its own.
MODULE first
  PROC main()
    TPWrite "["+RobName()+"]"\Num:=MotionPlannerNo();    ! -> [ROB_1]1
    TPWrite GetMecUnitName(ROB_ID);                       ! -> ROB_1
  ENDPROC
ENDMODULE
