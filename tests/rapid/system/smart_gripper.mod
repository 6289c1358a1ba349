! Field practice, the gripper of the IRB 14000: fingers that move at their speed, and are waited for.
MODULE smart_gripper
  VAR clock timer;

  PROC main()
    TPWrite ValToStr(g_IsCalibrated())+" "+ValToStr(g_GetPos());   ! -> TRUE 0
    g_Init \maxSpd:=20, \holdForce:=10;
    IF took()="" Stop;
    g_GripOut;
    TPWrite ValToStr(g_GetPos())+took();    ! -> 25 1.25
    g_MoveTo 5;
    TPWrite ValToStr(g_GetPos())+took();    ! -> 5 1
    Hand_MoveTo(10);
    TPWrite ValToStr(Hand_GetActualPos())+took();                  ! -> 10 0.25
    ! Without an object in the station file they close, and the run says so once.
    g_GripIn;                               ! warning: R104
    TPWrite ValToStr(g_GetPos())+took();    ! -> 0 0.5
    g_MoveTo 10;
    IF took()="" Stop;
    ! An object is expected where the program says.
    g_GripIn \holdForce:=5 \targetPos:=6 \posAllowance:=1;         ! warning: R104
    TPWrite ValToStr(g_GetPos())+took();    ! -> 6 0.2
    ! Without waiting the program goes on, and the fingers are under way.
    g_MoveTo 16 \NoWait;
    TPWrite ValToStr(g_GetPos())+took();    ! -> 6 0
    WaitTime 0.25;
    TPWrite ValToStr(Round(g_GetPos()\Dec:=2))+" "+ValToStr(Round(g_GetSpd())); ! -> 11 20
    Hand_WaitMovingCompleted;
    TPWrite ValToStr(g_GetPos())+" "+ValToStr(g_GetSpd());         ! -> 16 0
    g_MoveTo 0 \NoWait;
    WaitTime 0.3;
    g_Stop;
    WaitTime 1;
    TPWrite ValToStr(Round(g_GetPos()\Dec:=2));                    ! -> 10
    g_SetMaxSpd 5;
    IF took()="" Stop;
    g_JogIn;
    TPWrite ValToStr(g_GetPos())+took();    ! -> 0 2
    ! A limit of opening.
    Hand_Initialize\maxSpd:=10\holdForce:=10\phyLimit:=20\Calibrate;
    Hand_SetMaxSpeed 10;
    Hand_SetHoldForce 12;
    Hand_GripOutward;
    TPWrite ValToStr(g_GetPos());           ! -> 20
    g_MoveTo 24;                            ! warning: R104
    TPWrite ValToStr(g_GetPos());           ! -> 20
    g_Calibrate\Jog;
    g_Calibrate\Grip;
    TPWrite ValToStr(g_GetPos());           ! -> 0
  ENDPROC

  FUNC string took()
    VAR num seconds;
    ClkStop timer;
    seconds:=ClkRead(timer);
    ClkReset timer;
    ClkStart timer;
    RETURN " "+ValToStr(Round(seconds\Dec:=2));
  ENDFUNC
ENDMODULE
