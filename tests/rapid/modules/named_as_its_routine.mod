! RAPID Kernel, Modules: a module and a routine in it do not share a name.
MODULE named_as_its_routine
  PROC main()
    named_as_its_routine;
  ENDPROC

  PROC named_as_its_routine()                          ! error: N202
    TPWrite "never";
  ENDPROC
ENDMODULE
