! RAPID Instructions, StopMove: a robot that nobody starts again is an endless wait.
MODULE stopped_for_ever
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    StopMove;
    MoveL p2,v500,fine,tool0;           ! stops: the robot was stopped by StopMove, and nothing restarts it
  ENDPROC
ENDMODULE
