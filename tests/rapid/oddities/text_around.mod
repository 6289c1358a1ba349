This file was written by a tool.
! Field practice, Files: text before MODULE is reported and not read. ! error: E110
MODULE text_around
  PROC main()
    undeclared:=1;                        ! error: N201
  ENDPROC
ENDMODULE
