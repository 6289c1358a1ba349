MODULE example
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    MoveC Offs(p,0,50,0),Offs(p,0,100,0),v200,fine,tool0; ! found
  ENDPROC
ENDMODULE
