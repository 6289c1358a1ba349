! Field practice, StopMoveReset: programs of robots take back the stops of all tasks; here of their own robot.
MODULE reset_of_all_by_a_robot
  PROC main()
    StopMove;
    StopMoveReset\AllMotionTasks;           ! note: R119
    TPWrite ValToStr(IsStopMoveAct(\FromMoveTask));  ! -> FALSE
    StopMoveReset\AllMotionTasks;
    TPWrite "goes on";                      ! -> goes on
  ENDPROC
ENDMODULE
