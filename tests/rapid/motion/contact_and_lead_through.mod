! RAPID Instructions, ContactL: a line that meets nothing; SetLeadThrough is skipped. Both are said.
MODULE contact_and_lead_through
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget p;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    ContactL Offs(p,0,0,-15),v100,tool0;    ! warning: R104
    TPWrite ValToStr(Round(Distance(CPos(),p.trans))); ! -> 15
    SetLeadThrough\On;                      ! warning: R104
    SetLeadThrough\Off;
    TPWrite "on";                           ! -> on
  ENDPROC
ENDMODULE
