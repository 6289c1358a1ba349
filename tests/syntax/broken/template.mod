MODULE template
  CONST robtarget p{{NAME}}:=[[{{X}},0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveL p10,v100,fine,tool0;
    ...
    MoveL p20,v100,fine,tool0;
  ENDPROC
ENDMODULE
