MODULE example
  PROC main()
    SoftAct 3,20; ! found
  ENDPROC
ENDMODULE
