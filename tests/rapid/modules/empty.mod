! RAPID Kernel, Module declarations: a module may hold nothing but main, and main nothing at all.
MODULE empty
  PROC main()
  ENDPROC
ENDMODULE
