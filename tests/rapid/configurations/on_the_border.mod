! Field practice, Axis configuration: an axis on the border of a quarter turn stands on both sides.
MODULE on_the_border
  CONST robtarget right:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget left:=[[700,0.0001,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ right,v500,fine,tool0;
    MoveJ left,v500,fine,tool0;
    TPWrite "both";                     ! -> both
  ENDPROC
ENDMODULE
