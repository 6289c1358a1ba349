! RAPID Data types, iounit_state: states, domains and modes have names of their own types.
MODULE named_numbers
  VAR iounit_state unit:=IOUNIT_RUNNING;
  VAR busstate bus:=BUSSTATE_RUN;
  VAR tsp_status of_task:=TSP_STATUS_ACT;
  VAR signalorigin origin:=SIGORIG_CFG;
  VAR cfgdomain domain:=EIO_DOMAIN;
  VAR icondata icon:=iconWarning;
  VAR motionprocessmode mode:=OPTIMAL_CYCLE_TIME_MODE;
  VAR tunetype tune:=TUNE_DF;
  VAR paridnum load:=TOOL_LOAD_ID;
  VAR sensorstate sensor_state:=STATE_CONNECTED;

  PROC main()
    TPWrite ValToStr(unit);                 ! -> 1
    TPWrite ValToStr(unit=IOUNIT_DISABLE);  ! -> FALSE
    TPWrite ValToStr(bus=BUSSTATE_HALTED);  ! -> FALSE
    TPWrite ValToStr(IOUNIT_PHYS_STATE_RUNNING); ! -> 21
    TPWrite ValToStr(origin);                 ! -> 1
    TPWrite diskram;                        ! -> RAMDISK:
  ENDPROC
ENDMODULE
