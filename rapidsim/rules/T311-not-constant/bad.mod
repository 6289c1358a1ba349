MODULE example
  VAR num count:=3;
  VAR num twice:=count*2; ! found
ENDMODULE
