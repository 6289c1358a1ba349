! RAPID Instructions, MoveAbsJ: axis positions name their configuration themselves.
MODULE axes_need_none
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];

  PROC main()
    VAR robtarget now;
    MoveAbsJ [[100,0,0,0,30,100],none],vmax,fine,tool0;
    now:=CRobT(\Tool:=tool0);
    TPWrite ValToStr(now.robconf);      ! -> [1,0,1,0]
    MoveAbsJ [[-10,0,0,0,-30,-10],none],vmax,fine,tool0;
    now:=CRobT(\Tool:=tool0);
    TPWrite ValToStr(now.robconf);      ! -> [-1,0,-1,1]
  ENDPROC
ENDMODULE
