MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[-1,-3,4,7],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget two_arms:=[[400,200,300],[0,0,1,0],[0,-1,1,1011],[-103,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget not_set:=[[600,0,600],[0,0,1,0],[9E9,9E9,9E9,9E9],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
