! RAPID Instructions, TriggInt: an interrupt at a place; TriggCheckIO where a signal is not as it must be.
MODULE triggers_that_check
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum place;
  VAR intnum wrong;
  VAR triggdata t1;
  VAR triggdata t2;
  VAR triggdata t3;
  VAR triggdata none;
  VAR robtarget p;

  PROC main()
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    CONNECT place WITH there;
    CONNECT wrong WITH bad;
    TriggInt t1,50,place;
    TriggCheckIO t2,100,doGrip,EQ,1,wrong;  ! warning: I801
    TriggIO t3,30\Start\DOp:=doGrip,1;
    TPWrite ValToStr(TriggDataValid(t1))+ValToStr(TriggDataValid(none)); ! -> TRUEFALSE
    TriggL Offs(p,-200,0,0),v200,t1\T2:=t2\T3:=t3,fine,tool0;
    TPWrite ValToStr(doGrip);               ! -> 1
    SetDO doGrip,0;
    TriggL p,v200,t2,fine,tool0;
    TriggDataCopy t1,none;
    TriggDataReset t1;
    TPWrite ValToStr(TriggDataValid(t1))+ValToStr(TriggDataValid(none)); ! -> FALSETRUE
    TriggL Offs(p,-200,0,0),v200,none,fine,tool0;
    TPWrite "end";                          ! -> end
  ENDPROC

  TRAP there
    VAR pos at;
    at:=CPos();
    TPWrite ValToStr(Round((at.x-p.trans.x)/10)); ! -> -15 ! -> -15
  ENDTRAP

  TRAP bad
    TPWrite "not gripped";                  ! -> not gripped
  ENDTRAP
ENDMODULE
