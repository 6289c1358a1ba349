MODULE optional_arguments
  PERS tooldata tPen:=[TRUE,[[0,0,100],[1,0,0,0]],[0.5,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wPaper:=[FALSE,TRUE,"",[[500,0,200],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p1:=[[0,0,0],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    Line p1\lift:=20\wobj:=wPaper;
    Line p1\up\wobj:=wPaper;
    Line p1;
  ENDPROC
  PROC Line(robtarget p\switch up|num lift\PERS wobjdata wobj)
    VAR num h:=0;
    IF Present(up) h:=50;
    IF Present(lift) h:=lift;
    MoveJ Offs(p,0,0,h),v100,fine,tPen\WObj?wobj;
    Forward p\wobj?wobj;
  ENDPROC
  PROC Forward(robtarget p\PERS wobjdata wobj)
    MoveL p,v50\V:=35,z1\Z:=0.3,tPen,\WObj?wobj;
  ENDPROC
ENDMODULE
