! Field practice, Broken shapes: prose after ENDMODULE.
MODULE text_after_module
  PROC main()
    TPWrite "read";
  ENDPROC
ENDMODULE
This program moves the robot home.
! error: E110
