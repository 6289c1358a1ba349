MODULE example
  PROC pick(switch fast) ! found
  ENDPROC
ENDMODULE
