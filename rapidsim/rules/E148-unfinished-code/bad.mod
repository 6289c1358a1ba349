MODULE example
  PROC main()
    <SMT> ! found
  ENDPROC
ENDMODULE
