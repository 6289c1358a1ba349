MODULE example
  CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,2,2,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL b,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
