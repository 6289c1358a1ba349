MODULE example
  PERS wobjdata wVice:=[FALSE,TRUE,"",[[700,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget over:=[[0,0,320],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ over,v500,fine,tool0\WObj:=wVice;
  ENDPROC
ENDMODULE
