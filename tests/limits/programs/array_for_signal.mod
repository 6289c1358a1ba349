MODULE job
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo outs{2};
  VAR signalai ins{2};
  VAR signalgo groups{2};
  VAR triggdata t;
  PROC main()
    SetDO outs,1;
    Set outs;
    PulseDO outs;
    IF DOutput(outs)=1 TPWrite "on";
    IF AInput(ins)=1 TPWrite "on";
    WaitAI ins,\GT,1;
    SetGO groups,1;
    TriggIO t,5\DOp:=outs,1;
  ENDPROC
ENDMODULE
