! RAPID Functions, OpMode, RunMode, RobOS and others: what a program is told of where it runs.
MODULE facts_of_the_controller

  PROC main()
    TPWrite ValToStr(OpMode()=OP_AUTO)+ValToStr(RunMode()=RUN_CONT_CYCLE);    ! -> TRUETRUE
    TPWrite ValToStr(NonMotionMode())+ValToStr(RobOS());                      ! -> FALSEFALSE
    TPWrite GetTaskName()+" "+RobName();                                      ! -> T_ROB1 ROB_1
    TPWrite ValToStr(TaskRunRob())+ValToStr(TaskRunMec());                    ! -> TRUETRUE
    TPWrite ValToStr(EventType()=EVENT_NONE)+ValToStr(PFRestart());           ! -> TRUEFALSE
    TPWrite ValToStr(UIClientExist());                                        ! -> TRUE
    TPWrite ValToStr(GetMaxNumberOfCyclicBool()>=60);                         ! -> TRUE
  ENDPROC
ENDMODULE
