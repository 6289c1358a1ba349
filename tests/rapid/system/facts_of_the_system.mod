! RAPID Functions, GetTSPStatus: what a program asks of its controller, and what is taken instead.
MODULE facts_of_the_system
  PROC main()
    TPWrite ValToStr(GetTSPStatus("T_ROB1")=TSP_STATUS_ACT); ! -> TRUE
    TPWrite ValToStr(IsSysId("6400-1234")); ! -> FALSE
    TPWrite ValToStr(IsSysId(GetSysInfo(\CtrlId))); ! -> TRUE
    TPWrite ValToStr(ProgMemFree()>1000000); ! -> TRUE ! warning: R104
    MechUnitLoad ROB_1,1,load0;             ! note: R119
    SpyStart "HOME:/spy.log";               ! note: R119
    SpyStop;                                ! note: R119
    TPWrite ValToStr(GetTSPStatus("T_NONE")=TSP_STATUS_ACT);
  ERROR
    TPWrite "no task "\Bool:=ERRNO=ERR_TASKNAME; ! -> no task TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
