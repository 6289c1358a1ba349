! RAPID Instructions, Break: the program stops at once, wherever the robot is.
MODULE break
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    TPWrite "before";                       ! -> before
    Break;                                  ! note: R107 ! ends: stopped
    TPWrite "never";
  ENDPROC
ENDMODULE
