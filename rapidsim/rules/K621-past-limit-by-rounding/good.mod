MODULE example
  CONST robtarget p10:=[[-772,100,482],[0,1,0,0],[1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
