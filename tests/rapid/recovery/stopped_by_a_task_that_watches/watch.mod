! RAPID Instructions, IsStopMoveAct: who holds the robot, its own task or one that watches.
MODULE watch
  PROC main()
    WaitTime 1;
    StopMove;
    TPWrite "task "\Bool:=IsStopMoveAct(\FromMoveTask);           ! -> task FALSE
    TPWrite "watcher "\Bool:=IsStopMoveAct(\FromNonMoveTask);     ! -> watcher TRUE
    WaitTime 8;
    StartMove\AllMotionTasks;
    TPWrite "watcher "\Bool:=IsStopMoveAct(\FromNonMoveTask);     ! -> watcher FALSE
    WaitUntil IsStopMoveAct(\FromMoveTask)\MaxTime:=20;
    TPWrite "watcher "\Bool:=IsStopMoveAct(\FromNonMoveTask);     ! -> watcher FALSE
    StopMove\AllMotionTasks;
    WaitTime 5;
    StopMoveReset\AllMotionTasks;
  ENDPROC
ENDMODULE
