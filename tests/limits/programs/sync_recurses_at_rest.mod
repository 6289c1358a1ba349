MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v500,fine,tool0;
    MoveLSync p2,v50,z10,tool0,"again";
  ENDPROC
  PROC again()
    again;
  ENDPROC
ENDMODULE
