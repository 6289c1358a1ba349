! RAPID Kernel, Module declarations: a file may hold several; LOCAL ends with the module.
MODULE first
  LOCAL CONST num secret:=1;

  PROC main()
    TPWrite ValToStr(secret);           ! -> 1
    other;
  ENDPROC
ENDMODULE

MODULE second
  LOCAL CONST num secret:=2;

  PROC other()
    TPWrite ValToStr(secret);           ! -> 2
  ENDPROC
ENDMODULE
