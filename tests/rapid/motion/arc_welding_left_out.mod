! RAPID Instructions, ArcL: weaving and tracking do not move the torch, and the run says so.
MODULE arc_welding_left_out
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS seamdata seam:=[0,0,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0];
  PERS welddata weld:=[0,0,[0,0,0,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
  PERS weavedata weave:=[1,0,2,3,0,0,0,0,0,0,0,0,0,0,0];

  PROC main()
    VAR robtarget p;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    ArcL Offs(p,0,0,-30),v500,seam,weld\Weave:=weave,fine,tool0; ! warning: R104, R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 30
  ENDPROC
ENDMODULE
