! RAPID Kernel, Scope rules: LOCAL routines belong to their module.
MODULE Tools
  LOCAL PROC hidden_report()
    TPWrite "of Tools";
  ENDPROC
ENDMODULE
