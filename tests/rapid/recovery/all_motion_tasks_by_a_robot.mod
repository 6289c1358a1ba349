! RAPID Instructions, StopMove: \AllMotionTasks is for tasks without a robot.
MODULE all_motion_tasks_by_a_robot
  PROC main()
    StopMove;
    StartMove;
    StopMove\AllMotionTasks;            ! stops: StopMove \AllMotionTasks in the task of a robot; it is for tasks that watch
  ENDPROC
ENDMODULE
