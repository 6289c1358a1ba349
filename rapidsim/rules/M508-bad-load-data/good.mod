MODULE example
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[0.8,[0,0,60],[1,0,0,0],0,0,0]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,pen;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[0.001,[0,0,0],[1,0,0,0],0,0,0]];
  PERS tooldata grinder:=[FALSE,[[900,0,500],[1,0,0,0]],[0,[0,0,0],[1,0,0,0],0,0,0]];
  TASK PERS loaddata part:=[5,[0,0,50],[1,0,0,0],0.01,0.01,0];
  ! Nothing is carried, as with load0.
  PERS loaddata none:=[0,[0,0,50],[1,0,0,0],0,0,0];
ENDMODULE
