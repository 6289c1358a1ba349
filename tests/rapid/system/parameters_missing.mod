! RAPID Instructions, ReadCfgData: what the configuration does not have is an error.
MODULE parameters_missing
  PROC main()
    VAR num offset;
    ReadCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",offset;
    WriteCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",offset;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_CFG_NOTFND); ! -> TRUE ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
