! Field practice, the gripper of the IRB 14000: an object between the fingers, and air lines.
MODULE right
  PROC main()
    g_GripOut;
    g_GripIn \targetPos:=13;
    TPWrite ValToStr(g_GetPos());           ! -> 12
    ! The object is not where the program expects it.
    g_GripIn \targetPos:=8 \posAllowance:=1;
    g_GripIn \targetPos:=8 \NoWait;
    g_VacuumOn1;
    TPWrite ValToStr(DOutput(hand_CmdVacuum1_R)); ! -> 1
    Hand_TurnOffVacuum1;
    g_BlowOn1;
    TPWrite ValToStr(DOutput(hand_CmdVacuum1_R))+ValToStr(DOutput(hand_CmdBlowoff1_R)); ! -> 01
    g_BlowOff1;
    ! The cell has no output for the second line.
    g_VacuumOn2;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_HAND_FAILEDGRIPPOS); ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
