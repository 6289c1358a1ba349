MODULE loads
  PERS loaddata loadPart:=[5.2,[0,0,80],[1,0,0,0],0.05,0.05,0.02];
  PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[2,[0,0,70],[1,0,0,0],0,0,0]];
  CONST robtarget pT:=[[600,0,500],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    GripLoad load0;
    MoveJ pT,v500,fine,tGrip;
    GripLoad loadPart;
    SoftAct 3,20\Ramp:=150;
    MotionSup\Off;
    MoveL Offs(pT,0,0,-50),v50,fine,tGrip\TLoad:=loadPart;
    SoftDeact;
    MotionSup\On\TuneValue:=120;
    GripLoad load0;
  ENDPROC
ENDMODULE
