! RAPID Instructions, Search_Groove: the centre of a groove is displaced along the search, as
! far as its part is; depth and width are taken as they were taught.
MODULE groove
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget p;
    VAR pose found;
    VAR num width;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    Search_Groove found,width,Offs(p,0,-25,0),p,8,v100,tool0; ! warning: R104
    TPWrite ValToStr(found);                ! -> [[0,2,0],[1,0,0,0]]
    TPWrite ValToStr(width);                ! -> 8
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 25
  ENDPROC
ENDMODULE
