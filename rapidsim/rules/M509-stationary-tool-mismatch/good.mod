MODULE example
  PERS tooldata grinder:=[FALSE,[[900,0,500],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p10:=[[0,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,grinder\WObj:=part;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS tooldata grinder:=[FALSE,[[900,0,500],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0\WObj:=wobj0;
    MoveJ p20,v500,fine,grinder\WObj:=part;
    by_parameter grinder,part;
  ENDPROC
  PROC by_parameter(PERS tooldata tool,PERS wobjdata wobj)
    MoveJ Offs(p10,0,0,10),v500,fine,tool\WObj:=wobj;
  ENDPROC
ENDMODULE
