MODULE example
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[0,[0,0,60],[1,0,0,0],0,0,0]]; ! found
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,pen;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PERS tooldata no_mass:=[TRUE,[[0,0,120],[1,0,0,0]],[0,[0,0,60],[1,0,0,0],0,0,0]];          ! found
  PERS tooldata unknown:=[TRUE,[[0,0,120],[1,0,0,0]],[-1,[0,0,60],[1,0,0,0],0,0,0]];         ! found
  PERS loaddata part:=[5,[0,0,50],[1,0,0,0],0.01,-0.01,0];                                   ! found
ENDMODULE
