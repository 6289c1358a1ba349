MODULE example
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,pen;
    MoveL p10,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveJ p10,v500,fine,pen;
    MoveL p10,v500,fine,tool0;                 ! found
    MoveJ p20,v500,fine,pen\WObj:=table;
    MoveL p20,v500,fine,pen;                   ! found
  ENDPROC
ENDMODULE
! ---
MODULE beside
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveJ Offs(p10,0,0,50),v500,fine,tool0\WObj:=table;           ! found
    MoveL p10,v500,fine,pen\WObj:=table;
    MoveL RelTool(Offs(p10,0,0,9),0,0,-50),v500,fine,pen;         ! found
  ENDPROC
ENDMODULE
