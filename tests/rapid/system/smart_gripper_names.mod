! Field practice, the gripper of the IRB 14000: the longer names of the same routines, and air lines.
MODULE smart_gripper_names
  PROC main()
    IF NOT Hand_IsCalibrated() Hand_DoCalibrate;
    Hand_SetMaxSpeed 25;
    g_SetForce 5;
    g_JogOut;
    TPWrite ValToStr(Hand_GetActualPos());  ! -> 25
    Hand_JogInward;
    TPWrite ValToStr(Hand_GetActualPos());  ! -> 0
    Hand_JogOutward;
    TPWrite ValToStr(Hand_GetActualPos());  ! -> 25
    Hand_MoveTo 0 \NoWait;
    WaitTime 0.2;
    TPWrite ValToStr(Round(Hand_GetActualSpeed())); ! -> 25
    Hand_Stop;
    TPWrite ValToStr(Round(Hand_GetActualPos()))+" "+ValToStr(Hand_GetActualSpeed()); ! -> 20 0
    Hand_GripInward\holdForce:=10,\targetPos:=12,\posAllowance:=1,\NoWait; ! warning: R104
    Hand_WaitMovingCompleted;
    TPWrite ValToStr(Hand_GetActualPos());  ! -> 12
    Hand_TurnOnVacuum1;
    Hand_TurnOffVacuum1;
    Hand_TurnOnBlow1;
    Hand_TurnOffBlow1;
    Hand_TurnOnVacuum2;
    Hand_TurnOffVacuum2;
    Hand_TurnOnBlow2;
    Hand_TurnOffBlow2;
    g_VacuumOn1;
    g_VacuumOff1;
    g_BlowOn1;
    g_BlowOff1;
    g_VacuumOn2;
    g_VacuumOff2;
    g_BlowOn2;
    g_BlowOff2;
  ENDPROC
ENDMODULE
