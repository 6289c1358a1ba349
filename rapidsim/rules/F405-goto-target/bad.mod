MODULE example
  PROC main()
    GOTO again; ! found
  ENDPROC
ENDMODULE
