! Field practice, Broken shapes: a comma too many in the attributes.
MODULE module_attributes(SYSMODULE,,READONLY)   ! error: E114
  PROC main()
    TPWrite "still read";
  ENDPROC
ENDMODULE
