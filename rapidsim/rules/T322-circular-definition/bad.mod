MODULE example
  CONST num first:=second+1; ! found
  CONST num second:=first-1;
ENDMODULE
