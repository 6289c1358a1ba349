MODULE example
  PROC main()
    TPWrite "Forward";
  ENDPROC
ENDMODULE
