MODULE triggers
  VAR triggdata glueOn;
  VAR triggdata glueOff;
  VAR triggdata atPlace;
  VAR intnum iPlace;
  CONST robtarget p1:=[[600,-100,400],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[600,100,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    TriggIO glueOn,0\Start\DOp:=doGlue,1;
    TriggEquip glueOff,5,0.1\DOp:=doGlue,0;
    CONNECT iPlace WITH trPlace;
    TriggInt atPlace,10,iPlace;
    MoveJ p1,v500,fine,tool0;
    TriggL p2,v200,glueOn\T2:=glueOff\T3:=atPlace,z5,tool0;
    TriggJ p1,v500,atPlace,fine,tool0;
    MoveLDO p2,v200,z5,tool0,doGlue,0;
  ENDPROC
  TRAP trPlace
    SetAO aoPressure,2.5;
  ENDTRAP
ENDMODULE
