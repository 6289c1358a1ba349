MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[150,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[250,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p30:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; ! found
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[150,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,0,600],[0,0,1,0],[0,0,0,0],[250,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p30:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];   ! found
  CONST robtarget p40:=[[600,0,600],[0,0,1,0],[0,0,0,0],[350,9,9E9,9E9,9E9,9E9]];   ! found
ENDMODULE
