MODULE example
  PERS num counts{3}:=[0,0,0];
  PROC main()
    Incr counts{2}; ! found
  ENDPROC
ENDMODULE
