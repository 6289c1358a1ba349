! RAPID Instructions, Search_1D: it goes its way, and the part is where it was taught.
MODULE search_with_the_torch
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget p;
    VAR pose found:=[[1,2,3],[1,0,0,0]];
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    Search_1D found,Offs(p,20,0,0),Offs(p,20,0,-30),v100,tool0; ! warning: R104
    TPWrite ValToStr(found);                ! -> [[0,0,0],[1,0,0,0]]
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 20
  ENDPROC
ENDMODULE
