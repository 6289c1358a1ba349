! ---
MODULE bad
  PROC main()
    AcmeGrip 1; ! found
  ENDPROC
ENDMODULE
