MODULE example
  VAR num heights{<DIM>}; ! found
ENDMODULE
