MODULE example
  VAR num count;
  VAR bool COUNT; ! found
ENDMODULE
