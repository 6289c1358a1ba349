MODULE example
  PROC main()
    TPWrite "C:\temp"; ! found
  ENDPROC
ENDMODULE
