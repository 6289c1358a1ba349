! RAPID Instructions, EGMWaitCond: where no sensor answers, the time-out ends it.
MODULE egm_waits
  VAR egmident guide;
  CONST egm_minmax near:=[-0.1,0.1];

  PROC main()
    EGMGetId guide;
    EGMSetupUC ROB_1,guide,"default","UCdevice"\Joint\CommTimeout:=1;
    EGMActJoint guide\J1:=near;
    EGMRunJoint guide,EGM_STOP_HOLD\NoWaitCond\J1\CondTime:=5;
    TPWrite "guided "+ValToStr(EGMGetState(guide)=EGM_STATE_RUNNING);  ! -> guided TRUE
    EGMWaitCond guide;                       ! warning: R150
    TPWrite "after it";                      ! -> after it
  ERROR
    IF ERRNO=ERR_UDPUC_COMM THEN
      TPWrite "nobody guides";               ! -> nobody guides
      EGMReset guide;
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
