Program for cell 4, do not edit
! Field practice, Broken shapes: text before MODULE. ! warning: E110
MODULE text_before_module
  PROC main()
    TPWrite "still read";                 ! -> still read
  ENDPROC
ENDMODULE
