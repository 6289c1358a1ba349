! RAPID Instructions, SpeedLimAxis: limits for when the system input LimitSpeed is 1, which no run has.
MODULE speed_limits
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock timer;
  VAR num free;

  PROC main()
    free:=taken();
    SpeedLimAxis ROB_1,1,2;             ! note: R119
    SpeedLimCheckPoint 50;              ! note: R119
    ! Without the input the robot is as fast as before.
    TPWrite ValToStr(Abs(taken()-free)<0.2); ! -> TRUE
    SpeedLimAxis ROB_1,7,2;
    SpeedLimAxis STN_9,1,2;             ! note: N214
    SpeedLimAxis ROB_1,2,0;
    SpeedLimCheckPoint 0;
    TPWrite "behind";                   ! -> behind
  ERROR
    TPWrite ValToStr(ERRNO=ERR_AXIS_PAR)+ValToStr(ERRNO=ERR_UNIT_PAR);
    ! -> TRUEFALSE
    ! -> FALSETRUE
    ! -> FALSEFALSE
    ! -> FALSEFALSE
    IF ERRNO=ERR_SPEEDLIM_VALUE TPWrite "too low";
    ! -> too low
    ! -> too low
    TRYNEXT;
  ENDPROC

  FUNC num taken()
    MoveAbsJ home,v500,fine,tool0;
    ClkReset timer;
    ClkStart timer;
    MoveAbsJ aside,v500,fine,tool0;
    ClkStop timer;
    RETURN ClkRead(timer);
  ENDFUNC
ENDMODULE
