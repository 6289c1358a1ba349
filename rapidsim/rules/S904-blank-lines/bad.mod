! ---
MODULE near_miss
  PROC main()




    WaitTime 1;
  ENDPROC
ENDMODULE
