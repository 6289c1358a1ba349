MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v500,z10,tool0;
    MoveLSync p2,v500,z10,tool0,"greet";
    MoveJSync p1,v500,z10,tool0,"greet";
    MoveCSync Offs(p1,0,50,30),p2,v500,z10,tool0,"greet";
    MoveL p1,v500,fine,tool0;
  ENDPROC
  PROC greet()
    TPWrite "greet";
  ENDPROC
ENDMODULE
