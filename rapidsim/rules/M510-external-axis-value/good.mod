MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[150,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[250,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p30:=[[600,0,500],[0,0,1,0],[0,0,0,0],[250,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
! ---
MODULE near_miss
  ! Some tools write 0 or 9999 for axes that are not connected.
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget p30:=[[600,0,500],[0,0,1,0],[0,0,0,0],[0,0,0,0,0,0]];
  CONST robtarget p40:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9999,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
