MODULE example
  VAR egmident id;
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    EGMGetId id;
    EGMSetupUC ROB_1,id,"default","UCdevice"\Joint\CommTimeout:=0.1;
    EGMActJoint id\J1:=[-0.5,0.5];
    EGMReset id;
  ENDPROC
ENDMODULE
