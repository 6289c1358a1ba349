! RAPID Instructions, TriggLIOs: outputs by name and place, without setting anything up.
MODULE triggs_by_name
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR triggios outs{2};
    VAR robtarget p;
    outs{1}.used:=TRUE;
    outs{1}.distance:=30;
    outs{1}.start:=TRUE;
    outs{1}.equiplag:=0;
    outs{1}.signalname:="doOne";
    outs{1}.setvalue:=1;
    outs{1}.xxx:=0;
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    TriggLIOs Offs(p,-60,0,0),v100\TriggData1:=outs,fine,tool0;
    TPWrite ValToStr(doOne);                ! -> 1 ! warning: I801
  ENDPROC
ENDMODULE
