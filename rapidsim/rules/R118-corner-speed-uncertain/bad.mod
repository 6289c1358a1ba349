MODULE example
  CONST robtarget p:=[[1800,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,0,400,0),v1000,z10,tool0; ! found
    MoveL Offs(p,300,800,0),v1000,fine,tool0;
  ENDPROC
ENDMODULE
