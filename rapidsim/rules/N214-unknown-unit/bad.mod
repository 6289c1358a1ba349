MODULE example
  PROC main()
    ActUnit Positioner; ! found
  ENDPROC
ENDMODULE
