! RAPID Kernel, Scope rules: global names of a task are unique.
MODULE a
  VAR num count;
  LOCAL VAR num mine;

  PROC main()
  ENDPROC
ENDMODULE
