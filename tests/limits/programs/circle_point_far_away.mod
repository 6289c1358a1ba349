MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v500,z10,tool0;
    CirPathMode\CirPointOri;
    MoveC Offs(p1,0,1E30,0),p2,v500,z10,tool0;
  ENDPROC
ENDMODULE
