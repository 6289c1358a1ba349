MODULE example
  PERS tooldata tGripper:=[TRUE,[[0,0,100],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
  PERS loaddata lPart:=[3,[0,0,80],[1,0,0,0],0,0,0];
  CONST robtarget p:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tGripper;
    GripLoad lPart;
    MoveL Offs(p,0,0,100),v200,fine,tGripper;
  ENDPROC
ENDMODULE
