MODULE example
  CONST speeddata v100:=[120,500,5000,1000]; ! found
  PROC main()
    WaitTime v100.v_tcp/1000;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST speeddata V100:=[120,500,5000,1000];             ! found
  PERS tooldata tool0:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];   ! found
  PROC main()
    CONST zonedata fine:=[FALSE,5,8,8,0.8,8,0.8];        ! found
    WaitTime v100.v_tcp/fine.pzone_tcp;
    tperase;
  ENDPROC
  PROC TPErase()                                         ! found
    WaitTime 1;
  ENDPROC
ENDMODULE
