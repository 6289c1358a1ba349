MODULE example
  CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL RelTool(a,0,0,50\Rz:=80),v2000,fine,tool0; ! found
  ENDPROC
ENDMODULE
