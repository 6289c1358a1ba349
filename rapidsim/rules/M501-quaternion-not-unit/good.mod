MODULE example
  CONST robtarget p10:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[900,0,600],[0.0000012,0.707107,0.707107,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST orient flipped:=[0,-1,0,0];
  CONST pos sizes{2}:=[[0.5,0.5,0.7],[1,2,3]];
  CONST num four{4}:=[1,2,3,4];
  ! What a variable has until it is given a value.
  VAR orient later:=[0,0,0,0];
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
ENDMODULE
