MODULE example
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,pen;
    MoveL p10,v500,fine,pen;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS tooldata pen:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;
  PROC main()
    MoveAbsJ home,v500,fine,tool0;
    MoveJ p10,v500,fine,pen\WObj:=table;
    MoveL p10,v500,fine,Pen\WObj:=Table;
    MoveL p20,v500,fine,tool0;
    here:=CRobT();
    MoveL here,v500,fine,tool0;
    MoveL here,v500,fine,pen;
  ENDPROC
ENDMODULE
