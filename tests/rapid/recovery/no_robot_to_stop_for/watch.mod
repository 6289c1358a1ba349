! RAPID Instructions, StorePath: the path belongs to the task that moves the robot.
MODULE watch
  PROC main()
    WaitTime 1;
    StopMove;
    StorePath;      ! stops: StorePath: the task T_WATCH has no robot
  ENDPROC
ENDMODULE
