! Field practice, Broken shapes: PROC without ().
MODULE procedure_without_parentheses
  PROC main                               ! error: E143
    TPWrite "still read";
  ENDPROC
ENDMODULE
