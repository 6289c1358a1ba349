! ---
MODULE near_miss
  PROC main()
    softGrip 1;
  ENDPROC
  PROC softGrip(num how)
    WaitTime how;
  ENDPROC
ENDMODULE
