MODULE example
  VAR bool ready;
  PROC main()
    ready:=1; ! found
  ENDPROC
ENDMODULE
