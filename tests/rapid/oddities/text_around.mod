This file was written by a tool.
! Field practice, Files: text before MODULE is reported and not read. ! warning: E110
MODULE text_around
  PROC main()
    TPWrite "read";                       ! -> read
  ENDPROC
ENDMODULE
