MODULE example
  PROC main()
    TPWrite "part picked; ! found
  ENDPROC
ENDMODULE
