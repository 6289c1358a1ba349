! RAPID Instructions, TestSignDefine: positions and speeds of axes through twelve channels.
MODULE test_signals
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum underway;
  VAR num position;
  VAR num speed;

  PROC main()
    TestSignReset;
    MoveAbsJ home,v500,fine,tool0;
    TestSignDefine 1,4000,ROB_1,5,0.004;
    TestSignDefine 2,4001,ROB_1,1,0;
    TestSignDefine 3,4000,ROB_ID,1,0.1;
    TPWrite ValToStr(Round(TestSignRead(1)\Dec:=3)); ! -> 30
    TPWrite ValToStr(Round(TestSignRead(2)\Dec:=3)); ! -> 0
    CONNECT underway WITH look;
    ITimer\Single,0.4,underway;
    MoveAbsJ aside,v500,fine,tool0;
    WaitTime 0.1;
    TPWrite ValToStr(Round(TestSignRead(2)\Dec:=3)); ! -> 0
    TPWrite ValToStr(Round(TestSignRead(3)\Dec:=3)); ! -> 60
    ! A definition replaces the one before.
    TestSignDefine 1,4000,ROB_1,1,0.004;
    TPWrite ValToStr(Round(TestSignRead(1)\Dec:=3)); ! -> 60
    TestSignDefine 1,4000,ROB_1,7,0.004;
    TestSignDefine 1,4000,STN_9,1,0.004;    ! note: N214
    TestSignDefine 13,4000,ROB_1,1,0.004;
    TPWrite "behind";                       ! -> behind
  ERROR
    TPWrite ValToStr(ERRNO=ERR_AXIS_PAR)+ValToStr(ERRNO=ERR_UNIT_PAR)+ValToStr(ERRNO=ERR_ARGVALERR);
    ! -> TRUEFALSEFALSE
    ! -> FALSETRUEFALSE
    ! -> FALSEFALSETRUE
    TRYNEXT;
  ENDPROC

  TRAP look
    GetJointData 1\Position:=position\Speed:=speed;
    ! The mean over 4 ms of an axis that speeds up is behind what it does now, by a little.
    TPWrite ValToStr(speed>5 AND Abs(TestSignRead(2)-speed)<1); ! -> TRUE
    ! A sample each 0.1 s is up to so much older.
    TPWrite ValToStr(TestSignRead(3)<=position AND TestSignRead(3)>position-0.1*speed-0.01); ! -> TRUE
  ENDTRAP
ENDMODULE
