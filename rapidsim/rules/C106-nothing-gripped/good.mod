MODULE example
  CONST robtarget over:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ Offs(over,0,0,50),v500,z10,tool0;
    MoveL Offs(over,0,0,15),v500,fine,tool0;
    SetDO doGrip,1;
    WaitTime 0.2;
  ENDPROC
ENDMODULE
