MODULE example
  VAR num step; ! found
ENDMODULE
