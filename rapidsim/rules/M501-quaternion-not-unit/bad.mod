MODULE example
  CONST robtarget p10:=[[900,0,600],[0,0,0.995,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[900,0,600],[0,0,0.995,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];     ! found
  CONST pose empty:=[[0,0,0],[0,0,0,0]];                                                  ! found
  CONST orient two{2}:=[[1,0,0,0],[0.7,0.7,0,0]];                                          ! found
  PERS tooldata pen:=[TRUE,[[0,0,120],[0.9,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];          ! found
  RECORD spot
    num number;
    pose place;
  ENDRECORD
  PERS spot first:=[1,[[1,2,3],[1,1,0,0]]];                                                ! found
  PROC main()
    MoveJ p10,v500,fine,pen;
    MoveL [[900,0,600],[0,0.7,0.7,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,pen;   ! found
  ENDPROC
ENDMODULE
