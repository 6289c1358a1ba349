! RAPID Instructions, SpotL: a line to the spot; the gun does not close, and the run says so.
MODULE spot_welding
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS spotdata spot:=[1,1];
  PERS num gun:=1;

  PROC main()
    VAR robtarget p;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    SpotL Offs(p,0,0,40),v500,gun,spot\InPos,tool0; ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 40
    SpotJ Offs(p,0,0,80),v500,gun,spot\InPos,tool0; ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 80
    SpotMJ Offs(p,0,0,60),v500\G1:=spot\G2:=spot,tool0; ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 60
    SpotML p,v500\G1:=spot\G2:=spot,tool0;  ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 0
  ENDPROC
ENDMODULE
