MODULE example
  PROC main()
    reg1:=%"count"%(); ! found
  ENDPROC
  FUNC num count()
    RETURN 1;
  ENDFUNC
ENDMODULE
