! RAPID Instructions, StopMoveReset: a stop is taken back, and one that is none is no error.
MODULE stop_reset
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    StopMoveReset;
    StopMove;
    TPWrite "stopped "\Bool:=IsStopMoveAct();    ! -> stopped TRUE
    StopMoveReset;
    TPWrite "stopped "\Bool:=IsStopMoveAct();    ! -> stopped FALSE
    MoveL p2,v500,fine,tool0;
    TPWrite "at "\Pos:=CPos(\Tool:=tool0);       ! -> at [700,200,600]
  ENDPROC
ENDMODULE
