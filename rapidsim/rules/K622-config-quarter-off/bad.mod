MODULE example
  CONST robtarget p10:=[[600,-50,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
