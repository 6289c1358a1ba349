MODULE example
  CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,0,200,0),v500,z1,tool0; ! found
    MoveL Offs(p,150,200,0),v500,fine,tool0;
  ENDPROC
ENDMODULE
