! ---
MODULE bad
  PROC main()
    CapNoProcess 1; ! found
  ENDPROC
ENDMODULE
