! RAPID Instructions, PDispOn: the program displacement moves all that follows; ORobT takes it away.
MODULE displacement_taken_away
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;
  VAR robtarget q;
  VAR pos at;

  PROC main()
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    q:=Offs(p,-50,0,0);
    MoveL q,v1000,fine,tool0;
    PDispOn p,tool0;
    at:=CPos();
    TPWrite ValToStr(Round(at.x-p.trans.x)); ! -> 0
    TPWrite ValToStr(C_PROGDISP.pdisp.trans.x<-49.9); ! -> TRUE
    MoveL p,v1000,fine,tool0;
    PDispOff;
    at:=CPos();
    TPWrite ValToStr(Round(at.x-p.trans.x)); ! -> -50
    PDispSet [[0,0,20],[1,0,0,0]];
    MoveL p,v1000,fine,tool0;
    q:=CRobT();
    TPWrite ValToStr(Round(q.trans.z-p.trans.z)); ! -> 0
    q:=ORobT(q);
    TPWrite ValToStr(Round(q.trans.z-p.trans.z)); ! -> 20
    PDispOff;
    PDispOn\ExeP:=Offs(p,0,0,-30),p,tool0;
    MoveL p,v1000,fine,tool0;
    PDispOff;
    at:=CPos();
    TPWrite ValToStr(Round(at.z-p.trans.z)); ! -> -30
  ENDPROC
ENDMODULE
