! Field practice, Broken shapes: prose after ENDMODULE.
MODULE text_after_module
  PROC main()
    TPWrite "read";  ! -> read
  ENDPROC
ENDMODULE
This program moves the robot home.
! warning: E124
