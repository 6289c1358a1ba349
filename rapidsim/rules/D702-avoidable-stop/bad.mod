MODULE example
  CONST robtarget a:=[[700,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL Offs(a,10,0,0),v500,fine,tool0; ! found
    MoveL Offs(a,20,0,0),v500,fine,tool0;
  ENDPROC
ENDMODULE
