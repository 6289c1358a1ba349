MODULE logger
  TASK PERS tooldata t4:=[TRUE,[[31.792631,0,229.638935],[0.945519,0,0.325568,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wobj1:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p10:=[[600,-100,800],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[700,0,800],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum timer;
  VAR iodev logfile;
  VAR num x;
  VAR num xpos:=100;

  PROC main()
    Open "HOME:" \File:="LOGFILE2.DOC",logfile \Write;
    IDelete timer;
    CONNECT timer WITH Read;
    ITimer 0.1,timer;
    wobj1.oframe.trans.x:=xpos;
    MoveJ p10,v200,fine,t4;
    MoveL p20,v200,z10,t4\WObj:=wobj1;
    FOR i FROM 1 TO 4 DO
      MoveL Offs(p20,10*i,0,0),v200,z10,t4\WObj:=wobj1;
    ENDFOR
    IDelete timer;
    Close logfile;
  ENDPROC

  TRAP Read
    VAR robtarget here;

    here:=CRobT(\Tool:=t4\WObj:=wobj1);
    x:=here.trans.x;
    Write logfile,"X;"\num:=x;
  ENDTRAP
ENDMODULE
