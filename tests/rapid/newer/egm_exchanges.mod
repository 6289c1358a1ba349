! RAPID Instructions, EGMActJoint: values for the sensor and from it are options of all four.
MODULE egm_exchanges
  CONST egm_minmax near:=[-1,1];
  CONST pose here:=[[0,0,0],[1,0,0,0]];
  VAR egmident joints;
  VAR egmident poses;
  VAR dnum sent{40};
  VAR dnum got{40};
  VAR signaldo at_work;
  VAR signaldi wanted;

  PROC main()
    AliasIO "doWork",at_work;
    AliasIO "diWanted",wanted;
    EGMGetId joints;
    EGMSetupUC ROB_1,joints,"default","UCdevice:"\Joint;
    EGMActJoint joints\DataToSensor:=sent,\DataFromSensor:=got\J1:=near;
    EGMActJoint joints\DOToSensor:=at_work\J1:=near;
    EGMActJoint joints\DIFromSensor:=wanted\J1:=near;
    EGMRunJoint joints,EGM_STOP_HOLD\NoWaitCond\DOToSensor:=at_work\J1;
    EGMReset joints;
    EGMGetId poses;
    EGMSetupUC ROB_1,poses,"default","UCdevice:"\Pose;
    EGMActPose poses\Tool:=tool0\DataToSensor:=sent,here,EGM_FRAME_BASE,here,EGM_FRAME_BASE\x:=near;
    EGMRunPose poses,EGM_STOP_HOLD\NoWaitCond\DataFromSensor:=got\x;
    EGMReset poses;
    TPWrite "ended";                        ! -> ended
  ENDPROC
ENDMODULE
