MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveL Offs(p10,0,0,50,v100,fine,tool0; ! found
  ENDPROC
ENDMODULE
