MODULE example
  PROC main()
    ConfL\On\Off; ! found
  ENDPROC
ENDMODULE
