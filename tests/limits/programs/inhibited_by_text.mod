MODULE job
  PERS bool inhibited:=TRUE;
  PERS string value:="one";
  PERS pose frame:=[[0,0,0],[1,0,0,0]];
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata near;
  PROC main()
    TriggIO near,5\DOp:=doGlue,1\Inhib:=inhibited\InhibSetValue:=value;
    TriggIO near,5\DOp:=doGlue,1\Inhib:=inhibited\InhibSetValue:=frame;
    MoveJ p1,v500,fine,tool0;
    TriggL Offs(p1,0,50,0),v500,near,fine,tool0;
  ENDPROC
ENDMODULE
