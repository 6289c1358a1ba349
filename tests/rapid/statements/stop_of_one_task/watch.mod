! RAPID Instructions, Stop: only the task that executes it stops.
MODULE watch
  PROC main()
    WaitTime 1;
    Stop;                               ! note: R107 ! ends: stopped
    TPWrite "never";
  ENDPROC
ENDMODULE
