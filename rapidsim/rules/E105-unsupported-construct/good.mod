MODULE example
  PROC main()
    WaitTime 0.5;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! A procedure of the program with the name of an option's instruction, and what is simulated.
  PROC main()
    ArcGlue 3;
    SetDO doGlue,1;
  ENDPROC
  PROC ArcGlue(num seconds)
    WaitTime seconds;
  ENDPROC
ENDMODULE
