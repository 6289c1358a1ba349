MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum soon;
  PROC main()
    CONNECT soon WITH ends;
    ITimer\Single,0.3,soon;
    MoveJ p1,v50,z10,tool0;
  ENDPROC
  TRAP ends
    ExitCycle;
  ENDTRAP
ENDMODULE
