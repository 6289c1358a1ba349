MODULE example
  ALIAS num level;
  ALIAS level height; ! found
ENDMODULE
