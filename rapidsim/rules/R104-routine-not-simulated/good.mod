! ---
MODULE near_miss
  PROC main()
    AcmeGrip 1;
  ENDPROC
  PROC AcmeGrip(num how)
    WaitTime how;
  ENDPROC
ENDMODULE
