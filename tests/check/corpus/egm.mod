MODULE egm
  VAR egmident id1;
  VAR egmstate st1;
  CONST egm_minmax lim:=[-1,1];
  VAR pose here:=[[0,0,0],[1,0,0,0]];
  PROC main()
    EGMReset id1;
    EGMGetId id1;
    st1:=EGMGetState(id1);
    EGMSetupUC ROB_1,id1,"default","UCdevice"\Pose;
    EGMActPose id1\StreamStart\Tool:=tool0\WObj:=wobj0,here,EGM_FRAME_WORLD,here,EGM_FRAME_WORLD\X:=lim\Y:=lim\Z:=lim;
    EGMRunPose id1,EGM_STOP_HOLD\X\Y\Z\CondTime:=20\RampInTime:=0.05;
    EGMReset id1;
  ENDPROC
ENDMODULE
