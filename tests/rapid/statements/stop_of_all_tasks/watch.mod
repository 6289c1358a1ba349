! RAPID Instructions, Stop \AllMoveTasks: all normal tasks stop.
MODULE watch
  PROC main()
    WaitTime 1;
    Stop \AllMoveTasks;                 ! note: R107 ! ends: stopped
    TPWrite "never";
  ENDPROC
ENDMODULE
