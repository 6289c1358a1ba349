! Field practice, abort: servers of motion clients stop and clear to be safe.
MODULE watch
  PROC main()
    WaitTime 1;
    StopMove;
    ClearPath;                                                   ! warning: R104
    StartMove;
    TPWrite "goes on";                                           ! -> goes on
  ENDPROC
ENDMODULE
