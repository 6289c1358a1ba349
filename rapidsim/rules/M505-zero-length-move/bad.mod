MODULE example
  CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,z10,tool0;
    MoveL a,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
