MODULE example
  CONST robtarget far:=[[3000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ far,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
