! ---
MODULE m
  CONST robtarget left:=[[100,800,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget right:=[[100,-800,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ left,v500,fine,tool0;
    MoveJ right,v200,fine,tool0;
  ENDPROC
ENDMODULE
