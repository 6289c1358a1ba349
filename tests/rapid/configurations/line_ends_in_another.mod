! RAPID Instructions, ConfL: a line that ends in another configuration stops the program.
MODULE line_ends_in_another
  CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,2,2,1],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ a,v500,fine,tool0;
    TPWrite "at a";                     ! -> at a
    MoveL b,v500,fine,tool0;            ! stops: the path to `b` arrives in configuration [0,0,0,0], not in the stored [0,2,2,1]
  ENDPROC
ENDMODULE
