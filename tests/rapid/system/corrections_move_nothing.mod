! RAPID Instructions, CorrWrite: corrections do not move the path here; each move with \Corr says so.
MODULE corrections_move_nothing
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR corrdescr height;

  PROC main()
    VAR robtarget p;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    CorrCon height;
    CorrWrite height,[0,0,10];
    MoveL Offs(p,0,0,20),v100,fine,tool0\Corr; ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 20
  ENDPROC
ENDMODULE
