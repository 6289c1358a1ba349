MODULE example
  PROC main()
    VAR num count;
    TPReadNum count, "How many parts?"; ! found
  ENDPROC
ENDMODULE
