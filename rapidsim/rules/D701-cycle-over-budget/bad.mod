MODULE example
  PROC main() ! found
    WaitTime 3;
  ENDPROC
ENDMODULE
