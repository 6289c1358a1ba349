! RAPID Instructions, ReadCfgData: the system parameters are those of the backup.
MODULE parameters_of_a_backup
  PROC main()
    VAR num offset;
    VAR dnum wide;
    VAR string kind;
    VAR bool flag;
    VAR num list;
    ReadCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",offset;
    TPWrite ValToStr(offset);               ! -> 1.25
    ReadCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",wide;
    TPWrite ValToStr(wide);                 ! -> 1.25
    ReadCfgData "/EIO/EIO_SIGNAL/diPart","SignalType",kind;
    TPWrite kind;                           ! -> DI
    ReadCfgData "/MOC/MOTOR_CALIB/rob1_1","valid_com_offset",flag;
    TPWrite ValToStr(flag);                 ! -> TRUE
    WriteCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",2.5;
    ReadCfgData "/MOC/MOTOR_CALIB/rob1_1","cal_offset",offset;
    TPWrite ValToStr(offset);               ! -> 2.5
    WHILE list<>END_OF_LIST DO
      ReadCfgData "/EIO/EIO_SIGNAL/Device/d652","Name",kind\ListNo:=list;
      TPWrite kind;                         ! -> diPart ! -> doGrip
    ENDWHILE
    ReadCfgData "/EIO/EIO_SIGNAL/Device/d652","Name",kind\ListNo:=list;
    ReadCfgData "/EIO/EIO_SIGNAL/diPart","SignalType",offset;
    ReadCfgData "/EIO/EIO_SIGNAL/diNone","SignalType",kind;
  ERROR
    TPWrite error_name(ERRNO);              ! -> bounds ! -> type ! -> not found
    TRYNEXT;
  ENDPROC

  FUNC string error_name(errnum number)
    IF number=ERR_CFG_OUTOFBOUNDS RETURN "bounds";
    IF number=ERR_CFG_ILLTYPE RETURN "type";
    IF number=ERR_CFG_NOTFND RETURN "not found";
    RETURN "another";
  ENDFUNC
ENDMODULE
