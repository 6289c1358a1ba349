MODULE example
  PROC main ! found
    TPErase;
  ENDPROC
ENDMODULE
