MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggios outs{1}:=[[TRUE,5,TRUE,0,"doGlue",1,0]];
  PROC main()
    MoveJ p1,v500,z10,tool0;
    TriggLIOs p2,v500\TriggData1:=outs,z10,tool0;
    TriggJIOs p1,v500\TriggData1:=outs,fine,tool0;
  ENDPROC
ENDMODULE
