! RAPID Instructions, MoveLGO: a group set in the middle of the corner, an analog output, a procedure.
MODULE moves_with_outputs
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;

  PROC main()
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    MoveLGO Offs(p,-50,0,0),v200,fine,tool0,goPart\Value:=5; ! warning: I801
    TPWrite ValToStr(GOutput(goPart));      ! -> 5
    MoveLAO Offs(p,-100,0,0),v200,fine,tool0,aoFlow,2.5; ! warning: I801
    TPWrite ValToStr(AOutput(aoFlow));      ! -> 2.5
    MoveJDO p,v500,fine,tool0,doOne,1;      ! warning: I801
    TPWrite ValToStr(DOutput(doOne));       ! -> 1
    MoveJSync Offs(p,-50,0,0),v500,z10,tool0,"told";
    MoveLSync p,v500,fine,tool0,"told";
    TPWrite "end";                          ! -> end
  ENDPROC

  PROC told()
    VAR pos at;
    at:=CPos();
    TPWrite ValToStr(Round((at.x-p.trans.x)/10)); ! -> -4 ! -> 0
  ENDPROC
ENDMODULE
