! RAPID Functions, IOUnitState: a device runs until the program switches it off.
MODULE io_devices
  PROC main()
    VAR busstate bus;
    TPWrite ValToStr(IOUnitState("d652")=IOUNIT_RUNNING); ! -> TRUE
    IODisable "D652",5;
    TPWrite ValToStr(IOUnitState("d652")=IOUNIT_DISABLE); ! -> TRUE
    TPWrite ValToStr(IOUnitState("d652"\Phys)=IOUNIT_PHYS_STATE_DEACTIVATED); ! -> TRUE
    TPWrite ValToStr(IOUnitState("d652"\Logic)=IOUNIT_LOG_STATE_DISABLED); ! -> TRUE
    IOEnable "d652",5;
    TPWrite ValToStr(IOUnitState("d652"\Phys)=IOUNIT_PHYS_STATE_RUNNING); ! -> TRUE
    IOBusStart "PROFINET";
    IOBusState "PROFINET",bus;
    TPWrite ValToStr(bus=BUSSTATE_RUN);     ! -> TRUE
    IOBusState "PROFINET",bus\Phys;
    TPWrite ValToStr(bus=IOBUS_PHYS_STATE_RUNNING); ! -> TRUE
  ENDPROC
ENDMODULE
