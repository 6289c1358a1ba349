MODULE example
  CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveL p1,v100,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE exchanged
  CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS tooldata gripper:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PROC main()
    MoveL p1,fine,v100,tool0;    ! found
    MoveL p1,gripper,fine,v100;  ! found
    name_it 3,"three";           ! found
  ENDPROC
  PROC name_it(string text,num number)
  ENDPROC
ENDMODULE
