! RAPID Instructions, Stop: only the task that executes it stops.
MODULE robot
  PROC main()
    WaitTime 2;
    TPWrite "goes on";                  ! -> goes on
  ENDPROC
ENDMODULE
