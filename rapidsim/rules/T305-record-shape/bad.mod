MODULE example
  CONST pos corner:=[100,200]; ! found
ENDMODULE
