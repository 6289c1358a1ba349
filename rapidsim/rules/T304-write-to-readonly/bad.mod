MODULE example
  CONST num limit:=5;
  PROC main()
    limit:=6; ! found
  ENDPROC
ENDMODULE
