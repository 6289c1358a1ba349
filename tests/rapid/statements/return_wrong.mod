! RAPID Kernel, RETURN: a value in functions, of their type, and nowhere else.
MODULE return_wrong
  PROC main()
    RETURN 1;                         ! error: F415
  ENDPROC

  FUNC num without()
    RETURN;                           ! error: F415
  ENDFUNC

  FUNC num other_type()
    RETURN "one";                     ! error: T301
  ENDFUNC

  FUNC num sometimes(num x)
    IF x>0 RETURN x;
  ENDFUNC                             ! warning: F404

  TRAP on_tick
    RETURN 1;                         ! error: F415
  ENDTRAP
ENDMODULE
