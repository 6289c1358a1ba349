! RAPID Instructions, ConfL: a configuration that no way could end in is told as such.
MODULE line_to_another_branch
  CONST robtarget a:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,-200,600],[0,0,1,0],[0,0,0,2],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL b,v500,fine,tool0;      ! stops: `b` cannot be reached in its stored configuration [0,0,0,2]: in [-1,0,-1,2] joint 5 would be at 153.6 deg, 38.6 deg past its limit; [-1,0,-1,0] reaches it
  ENDPROC
ENDMODULE
