! RAPID Kernel, Parameter declarations: switch is the type of optional parameters only.
MODULE switch_type
  VAR switch flag;                ! error: T320

  PROC main()
  ENDPROC

  PROC wrong(switch fast)         ! error: T320
  ENDPROC

  PROC right(\switch fast)
  ENDPROC
ENDMODULE
