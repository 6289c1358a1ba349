! RAPID Instructions, StopMove: the corner that was coming is taken when the robot goes on.
MODULE trap_while_it_flies_by
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum pause;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT pause WITH on_pause;
    ITimer \Single,0.5,pause;
    MoveL p2,v200,z20,tool0;
    MoveL Offs(p2,100,0,0),v200,fine,tool0;
    TPWrite "end "\Pos:=CPos(\Tool:=tool0);      ! -> end [800,200,600]
  ENDPROC

  TRAP on_pause
    StopMove;
    WaitTime 0.5;
    StartMove;
    TPWrite "on";                       ! -> on
  ENDTRAP
ENDMODULE
