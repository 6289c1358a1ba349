! RAPID Instructions, StopMove: a trap stops the robot on its path, and StartMove lets it go on.
MODULE stop_and_start
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum pause;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT pause WITH on_pause;
    ITimer \Single,0.5,pause;
    MoveL p2,v100,fine,tool0;
    TPWrite "there "\Num:=there(200);   ! -> there 0
  ENDPROC

  FUNC num there(num y)
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN Round(now.y-y\Dec:=1);
  ENDFUNC

  TRAP on_pause
    VAR pos here;
    StopMove;
    TPWrite "stopped "\Bool:=IsStopMoveAct();    ! -> stopped TRUE
    here:=CPos(\Tool:=tool0);
    WaitTime 1;
    TPWrite "stands "\Bool:=here=CPos(\Tool:=tool0);        ! -> stands TRUE
    TPWrite "on the way "\Bool:=here.y>20 AND here.y<180;   ! -> on the way TRUE
    StartMove;
    TPWrite "stopped "\Bool:=IsStopMoveAct();    ! -> stopped FALSE
  ENDTRAP
ENDMODULE
