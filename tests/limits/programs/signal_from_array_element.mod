MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo outs{2};
  PROC main()
    AliasIO "doA",outs{1};
    SetDO outs{1},1;
    outs{2}:=outs{1};
  ENDPROC
ENDMODULE
