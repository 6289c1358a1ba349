MODULE example
  PROC main()
    Set doGrip;
    WaitTime 0.4;
  ENDPROC
ENDMODULE
