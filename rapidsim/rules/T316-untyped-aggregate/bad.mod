MODULE example
  PROC main()
    TPWrite ValToStr([1,2,3]); ! found
  ENDPROC
ENDMODULE
