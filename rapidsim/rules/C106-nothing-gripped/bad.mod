MODULE example
  CONST robtarget over:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ Offs(over,0,0,50),v500,fine,tool0;
    SetDO doGrip,1; ! found
    WaitTime 0.2;
    MoveL Offs(over,0,200,50),v200,fine,tool0;
    SetDO doGrip,0;
  ENDPROC
ENDMODULE
