MODULE example
  CONST robtarget over:=[[700,0,620],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ over,v500,fine,tool0;
  ENDPROC
  PROC service()
    MoveJ over,v500,fine,tool0;
    MoveL Offs(over,0,0,-100),v200,fine,tool0;
    MoveL over,v200,fine,tool0;
  ENDPROC
ENDMODULE
