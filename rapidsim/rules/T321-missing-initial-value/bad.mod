MODULE example
  CONST num limit; ! found
ENDMODULE
