MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0.5,0,9],[9E9,9E9,9E9,9E9,9E9,9E9]]; ! found
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0.5,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];    ! found
  CONST robtarget p20:=[[600,0,600],[0,0,1,0],[0,0,0,9],[9E9,9E9,9E9,9E9,9E9,9E9]];      ! found
  CONST robtarget p30:=[[600,0,600],[0,0,1,0],[0,0,0,-1],[9E9,9E9,9E9,9E9,9E9,9E9]];     ! found
  CONST robtarget p40:=[[600,0,600],[0,0,1,0],[400,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];    ! found
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
