! RAPID Instructions, WZDOSet: a zone that is on tells an output; freed, it cannot be switched on again.
MODULE zone_switched
  VAR wztemporary zone;
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR shapedata ball;
    VAR robtarget p;
    VAR pos at;
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    at:=p.trans;
    WZSphDef\Inside,ball,at,20;
    WZDOSet\Temp,zone\Inside,ball,doInside,1; ! warning: I801
    WaitTime 0.1;
    TPWrite ValToStr(doInside);             ! -> 1
    MoveL Offs(p,-100,0,0),v500,fine,tool0;
    TPWrite ValToStr(doInside);             ! -> 0
    WZDisable zone;
    MoveL p,v500,fine,tool0;
    TPWrite ValToStr(doInside);             ! -> 0
    WZEnable zone;
    WaitTime 0.1;
    TPWrite ValToStr(doInside);             ! -> 1
    WZFree zone;
    TPWrite "end";                          ! -> end
  ENDPROC
ENDMODULE
