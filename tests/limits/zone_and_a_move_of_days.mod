! A zone is watched while the arm makes a move that takes days: nothing later than the time limit is
! looked at, and the computer's clock ends the looking.
MODULE zone_and_a_move_of_days
  VAR wztemporary zone;
  VAR shapedata ball;

  PROC main()
    WZSphDef \Inside, ball, [5000,0,0], 100;
    WZLimSup \Temp, zone, ball;
    MoveAbsJ [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], [0.001,0.001,0.001,0.001], fine, tool0;
  ENDPROC
ENDMODULE
