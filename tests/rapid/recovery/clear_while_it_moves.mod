! RAPID Instructions, ClearPath: the robot must stand; while it moves it is an error.
MODULE clear_while_it_moves
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    MoveL p2,v100,z10,tool0;
    ClearPath;                          ! stops: ClearPath while the robot moves; StopMove first (ERR_PATH)
  ENDPROC
ENDMODULE
