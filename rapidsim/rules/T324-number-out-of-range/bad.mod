MODULE example
  VAR num far:=1E39; ! found
ENDMODULE
