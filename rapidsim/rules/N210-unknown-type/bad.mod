MODULE example
  TASK PERS gluegundata gun1:=[1,5,[0,0]]; ! found
ENDMODULE
