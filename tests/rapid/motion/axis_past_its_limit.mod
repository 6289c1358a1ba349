! RAPID Instructions, MoveAbsJ: an axis past its limit stops the program, and no clause is called.
MODULE axis_past_its_limit
  CONST jointtarget start:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget over:=[[0,0,0,0,30,420],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ start,v500,fine,tool0;
    careful;
    TPWrite "not reached";
  ERROR
    TPWrite "nor this";
    TRYNEXT;
  ENDPROC

  PROC careful()
    MoveAbsJ over,v500,fine,tool0;
      ! stops: `over` exceeds the axis limits of ABB IRB 1600-6/1.2: axis 6 at 420.0 deg, 20.0 deg past its limit
  ERROR
    IF ERRNO=ERR_ROBLIMIT THEN
      TPWrite "nor this";
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
