! RAPID Instructions, TriggC: events on an arc; SearchC finds nothing on one.
MODULE circles_with_triggers
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum at_place;
  VAR triggdata t1;
  VAR triggdata both{2};
  VAR robtarget p;

  PROC main()
    VAR robtarget found;
    MoveAbsJ home,v1000,fine,tool0;
    p:=CRobT();
    CONNECT at_place WITH there;
    TriggInt t1,20,at_place;
    TriggIO both{1},10\DOp:=doOne,1;        ! warning: I801
    TriggEquip both{2},20\Start,0.05\GOp:=goPart,3; ! warning: I801
    TriggC Offs(p,-30,0,-30),Offs(p,-60,0,0),v100,t1,fine,tool0;
    TriggJ p,v100,both{1}\T2:=both{2},fine,tool0;
    TPWrite ValToStr(doOne)+ValToStr(GOutput(goPart)); ! -> 13
    SetDO doOne,0;
    SetGO goPart,0;
    TriggL Offs(p,-60,0,0),v100,both,fine,tool0;
    TPWrite ValToStr(doOne)+ValToStr(GOutput(goPart)); ! -> 13
    SearchC diFeel,found,Offs(p,-30,0,-30),p,v50,tool0; ! warning: I801
  ERROR
    TPWrite ValToStr(ERRNO=ERR_WHLSEARCH);  ! -> TRUE
    TRYNEXT;
  ENDPROC

  TRAP there
    TPWrite "there";                        ! -> there
  ENDTRAP
ENDMODULE
