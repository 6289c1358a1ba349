MODULE example
  PROC main()
    reg1=5; ! found
  ENDPROC
ENDMODULE
