! RAPID Instructions, TestSignDefine: torques, forces and what nothing defines read 0, and are told.
MODULE test_signals_not_simulated
  PROC main()
    TestSignDefine 1,4002,ROB_1,1,0.004;    ! warning: R104
    TestSignDefine 2,201,ROB_1,1,0;         ! warning: R104
    TestSignDefine 3,torque_ref,ROB_1,1,0;  ! warning: R104
    TPWrite ValToStr(TestSignRead(1));      ! -> 0 ! warning: R104
    TestSignDefine 4,4000,ROB_1,1,0;
    TPWrite ValToStr(TestSignRead(4));      ! -> 0
    TestSignReset;
    TPWrite ValToStr(TestSignRead(4));      ! -> 0 ! warning: R104
  ENDPROC
ENDMODULE
