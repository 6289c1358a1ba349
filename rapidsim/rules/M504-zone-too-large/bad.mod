MODULE example
  CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL Offs(a,0,60,0),v500,z100,tool0; ! found
    MoveL Offs(a,100,60,0),v500,fine,tool0;
  ENDPROC
ENDMODULE
