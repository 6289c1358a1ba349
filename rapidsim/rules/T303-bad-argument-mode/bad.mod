MODULE example
  CONST num start:=3;
  PROC main()
    Incr start; ! found
  ENDPROC
ENDMODULE
