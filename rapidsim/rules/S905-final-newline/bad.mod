! ---
MODULE ends_early
  PROC main()
  ENDPROC
ENDMODULE