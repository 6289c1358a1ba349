! RAPID Instructions, StopMove: the rest of a path that nothing resumes is not travelled.
MODULE stopped_at_the_end
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    MoveL p2,v500,z10,tool0;
    StopMove;                           ! stops: the robot was stopped by StopMove, and nothing restarts it
  ENDPROC
ENDMODULE
