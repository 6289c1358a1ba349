MODULE example
  CONST robtarget over:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ over,v500,fine,tool0;
    SetDO doGrip,1;
    WaitTime 0.2;
    MoveL Offs(over,0,0,150),v200,z10,tool0;
    MoveL Offs(over,0,200,150),v200,z10,tool0;
    MoveL Offs(over,0,200,100),v200,fine,tool0;
    SetDO doGrip,0;
    WaitTime 0.2;
  ENDPROC
ENDMODULE
