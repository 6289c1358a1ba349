MODULE example
  VAR num heights{0}; ! found
ENDMODULE
