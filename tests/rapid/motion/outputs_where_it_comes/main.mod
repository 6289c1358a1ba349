! RAPID Instructions, MoveLDO, MoveLAO, MoveLGO and MoveLSync: where the robot comes to the target.
MODULE outputs_where_it_comes
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum flank;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT flank WITH tell;
    ISignalDO doOne,edge,flank;
    MoveLDO Offs(p1,0,100,0),v200,fine,tool0,doOne,1;
    MoveLSync p1,v200,fine,tool0,"there";
    MoveLAO Offs(p1,0,50,0),v200,fine,tool0,aoOne,3.5;
    TPWrite ValToStr(AOutput(aoOne));       ! -> 3.5
    MoveLGO p1,v200,fine,tool0,goOne\Value:=9;
    TPWrite ValToStr(GOutput(goOne));       ! -> 9
    MoveJDO Offs(p1,0,10,0),v200,fine,tool0,doOne,0;
    WaitTime 0.1;
  ENDPROC

  TRAP tell
    TPWrite "now "+ValToStr(DOutput(doOne));    ! -> now 1 ! -> now 0
  ENDTRAP

  PROC there()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    TPWrite "there "\Num:=Round(now.y);     ! -> there 0
  ENDPROC
ENDMODULE
