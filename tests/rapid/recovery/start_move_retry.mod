! RAPID Instructions, StartMoveRetry: the robot goes on and the statement is executed again.
MODULE start_move_retry
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num attempts;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    work;
    TPWrite "at "\Pos:=CPos(\Tool:=tool0);       ! -> at [700,200,600]
  ENDPROC

  PROC work()
    attempt;
  ERROR
    StopMove;
    TPWrite "failed";                   ! -> failed
    StartMoveRetry;
  ENDPROC

  PROC attempt()
    Incr attempts;
    IF attempts=1 RAISE 8;
    MoveL p2,v500,fine,tool0;
  ENDPROC
ENDMODULE
