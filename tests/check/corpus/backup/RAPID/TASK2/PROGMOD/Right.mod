MODULE Right
  TASK PERS tooldata toolR:=[TRUE,[[0,0,136],[1,0,0,0]],[0.25,[8.2,11.7,52],[1,0,0,0],0.0002,0.0002,0.0001]];
  PERS tasks task_list{2}:=[["T_ROB_L"],["T_ROB_R"]];
  VAR syncident sync1;
  VAR syncident sync2;
  VAR num nGrip:=0x1F;
  PROC main()
    MoveAbsJ [[0,-130,30,0,40,0],[-135,9E9,9E9,9E9,9E9,9E9]]\NoEOffs,v1000,z50,toolR;
    WaitSyncTask\InPos,sync1,task_list\TimeOut:=20;
    SyncMoveOn sync2,task_list;
    MoveL [[330,-80,250],[0.06,0.84,0.11,0.52775],[0,0,0,4],[-101.96,9E9,9E9,9E9,9E9,9E9]]\ID:=10,v100,fine,toolR;
    SyncMoveOff sync2;
    TPWrite "grip = "\Num:=nGrip;
  ENDPROC
ENDMODULE
