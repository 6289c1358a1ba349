MODULE example
  PROC main()
    RETURN 1; ! found
  ENDPROC
ENDMODULE
