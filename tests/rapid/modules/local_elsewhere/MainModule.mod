! RAPID Kernel, Scope rules: a LOCAL procedure is not seen from other modules, but by its module's name.
MODULE MainModule
  PROC main()
    hidden_report;                      ! error: N209
    %"Tools:hidden_report"%;
  ENDPROC
ENDMODULE
