MODULE example
  PROC main()
    WaitTime 1;
    WaitTime 2;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PROC main()
    WaitTime 1; WaitTime 2;
    IF DOutput(doGlue)=1 THEN
        WaitTime 3;
        WaitTime 4;
    ENDIF
again:
    WaitTime
      5;
  ENDPROC
ENDMODULE
