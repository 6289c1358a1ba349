! RAPID Instructions, WaitTime: a task of its own.
MODULE watch
  PROC main()
    WaitTime 1;
  ENDPROC
ENDMODULE
