MODULE example
  PERS num grip(open):=1; ! found
ENDMODULE
