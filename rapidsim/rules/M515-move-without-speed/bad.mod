MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    MoveL Offs(p10,0,90,0),[0,500,5000,1000],fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  CONST speeddata stand:=[0,500,5000,1000];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    MoveL p20,stand,fine,tool0;                ! found
    MoveL p10,vrot10,fine,tool0;               ! found
    MoveC p20,Offs(p10,0,0,50),[0,90,0,0],fine,tool0;   ! found
  ENDPROC
ENDMODULE
