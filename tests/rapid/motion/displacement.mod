! RAPID Instructions, PDispOn: targets move with the displacement, and back when it ends.
MODULE displacement
  CONST robtarget p:=[[850,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST pose shift:=[[0,100,50],[1,0,0,0]];

  PROC main()
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    TPWrite ""\Pos:=place();      ! -> [850,0,600]
    PDispSet shift;
    MoveJ p,v500,fine,tool0;
    ! CRobT gives a position as the program has to write it: the displacement is taken off.
    TPWrite ""\Pos:=place();      ! -> [850,0,600]
    PDispOff;
    TPWrite ""\Pos:=place();      ! -> [850,100,650]
    PDispOn\ExeP:=Offs(p,-50,0,0),p,tool0;
    MoveJ p,v500,fine,tool0;
    PDispOff;
    TPWrite ""\Pos:=place();      ! -> [800,0,600]
  ENDPROC

  FUNC pos place()
    VAR robtarget here;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    RETURN [Round(here.trans.x),Round(here.trans.y),Round(here.trans.z)];
  ENDFUNC
ENDMODULE
