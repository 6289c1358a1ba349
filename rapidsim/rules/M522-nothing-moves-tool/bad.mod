MODULE example
  PERS tooldata glue:=[FALSE,[[900,0,700],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,glue; ! found
  ENDPROC
ENDMODULE
