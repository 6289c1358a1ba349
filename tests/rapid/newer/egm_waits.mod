! RAPID Instructions, EGMWaitCond: known, and not simulated (RobotWare 7).
MODULE egm_waits
  VAR egmident guide;

  PROC main()
    EGMRunJoint guide,EGM_STOP_HOLD\NoWaitCond\J1\CondTime:=5; ! warning: R104
    EGMWaitCond guide;                      ! warning: R104
    TPWrite "on";                           ! -> on
  ENDPROC
ENDMODULE
