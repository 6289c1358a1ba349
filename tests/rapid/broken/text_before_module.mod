Program for cell 4, do not edit
! Field practice, Broken shapes: text before MODULE. ! error: E110
MODULE text_before_module
  PROC main()
    TPWrite "read";
  ENDPROC
ENDMODULE
