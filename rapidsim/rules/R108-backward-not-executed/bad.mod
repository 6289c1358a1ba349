MODULE example
  PROC main() ! found
    TPWrite "Forward";
  BACKWARD
    TPWrite "Backward";
  ENDPROC
ENDMODULE
