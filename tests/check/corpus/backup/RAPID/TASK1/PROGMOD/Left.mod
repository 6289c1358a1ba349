MODULE Left
  TASK PERS tooldata toolL:=[TRUE,[[0,0,136],[1,0,0,0]],[0.25,[8.2,11.7,52],[1,0,0,0],0.0002,0.0002,0.0001]];
  PERS tasks task_list{2}:=[["T_ROB_L"],["T_ROB_R"]];
  VAR syncident sync1;
  VAR syncident sync2;
  CONST jointtarget jStart:=[[0,-130,30,0,40,0],[135,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pMeet:=[[330.1,80.9,200],[0.06,0.84,0.11,0.52775],[0,0,0,4],[101.96,9E+09,9E+09,9E+09,9E+09,9E+09]];
  PROC main()
    MoveAbsJ jStart\NoEOffs,v1000,fine,toolL;
    WaitSyncTask sync1,task_list;
    MoveJ pMeet,v200,fine,toolL;
    SyncMoveOn sync2,task_list;
    MoveL Offs(pMeet,0,0,50)\ID:=10,v100,fine,toolL;
    SyncMoveOff sync2;
    Hand_GripInward;
  ENDPROC
ENDMODULE
