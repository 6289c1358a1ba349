MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    MoveL Offs(p10,0,90,0),[50,500,5000,1000],fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,vrot10,fine,tool0;
    MoveL p20,vrot10\T:=2,fine,tool0;
    MoveL p10,v500\V:=20,fine,tool0;
    MoveL p20,[0.5,500,5000,1000],fine,tool0;
  ENDPROC
ENDMODULE
