! RAPID Instructions, Stop \AllMoveTasks: all normal tasks stop.
MODULE robot
  PROC main()
    TPWrite "begins";                   ! -> begins
    WaitTime 2;
    TPWrite "never";
  ENDPROC
ENDMODULE
