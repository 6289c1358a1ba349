MODULE failsBehind
  ! The way of the second move fails, which is told while the first, one of hours, is being made.
  PROC main()
    MoveL [[735,-80,601],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[0.01,500,5000,1000],z30,tool0;
    MoveL [[-735,-80,601],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z10,tool0;
    WaitTime 1;
  ENDPROC
ENDMODULE
