! RAPID Kernel, Modules: a module and a routine in it do not share a name; programs in use do.
MODULE named_as_its_routine
  PROC main()
    named_as_its_routine;
  ENDPROC

  PROC named_as_its_routine()                          ! warning: N202
    TPWrite "called";                                  ! -> called
  ENDPROC
ENDMODULE
