! RAPID Instructions, Stop: nobody presses Start in a simulation, so the run ends.
MODULE stop_instruction
  PROC main()
    TPWrite "before";                 ! -> before
    Stop;                             ! note: R107 ! ends: stopped
    TPWrite "never";
  ENDPROC
ENDMODULE
