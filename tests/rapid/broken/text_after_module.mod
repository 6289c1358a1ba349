! Field practice, Broken shapes: prose after ENDMODULE.
MODULE text_after_module
  PROC main()
    TPWrite "still read";                 ! -> still read
  ENDPROC
ENDMODULE
This program moves the robot home.
! warning: E110
