! Field practice, Broken shapes: a statement without its semicolon.
MODULE semicolon_missing
  PROC main()
    WaitTime 1                            ! error: E103
    TPWrite "still read";
  ENDPROC
ENDMODULE
