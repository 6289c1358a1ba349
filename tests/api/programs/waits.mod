MODULE waits
  PERS num nParts:=0;
  PROC main()
    VAR num chosen;
    MoveAbsJ [[0,0,0,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    WaitTime 0.5;
    SetDO doGrip,1;
    WaitDI diGripped,1;
    WaitUntil diGripped=0\MaxTime:=3;
    TPReadNum chosen,"How many?";
    nParts:=chosen;
    MoveAbsJ [[10,0,0,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    WaitDI diNever,1\MaxTime:=1;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
