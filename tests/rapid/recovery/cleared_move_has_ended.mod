! RAPID Instructions, ClearPath: a move whose path a trap clears has ended, where the robot stands.
MODULE cleared_move_has_ended
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum enough;
  VAR clock watch;
  VAR pos stopped;

  PROC main()
    CONNECT enough WITH on_enough;
    MoveJ p1,v500,fine,tool0;
    ClkStart watch;
    ITimer\Single,1,enough;
    MoveL p2,v100,fine,tool0;
    TPWrite "goes on at once "\Bool:=ClkRead(watch)<1.5;            ! -> goes on at once TRUE
    stopped:=CPos(\Tool:=tool0);
    TPWrite "half way "\Bool:=stopped.y>50 AND stopped.y<150;       ! -> half way TRUE
    MoveL p1,v100,fine,tool0;
    stopped:=CPos(\Tool:=tool0);
    TPWrite "back "\Bool:=Abs(stopped.y)<0.001;                     ! -> back TRUE
  ENDPROC

  TRAP on_enough
    StopMove;
    ClearPath;
    StartMove;
  ENDTRAP
ENDMODULE
