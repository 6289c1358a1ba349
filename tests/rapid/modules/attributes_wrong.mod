! RAPID Kernel, Module declarations: known attributes, parted by commas.
MODULE attributes_wrong(SYSMODULE,PRIVATE)   ! error: E117
  PROC main()
  ENDPROC
ENDMODULE
