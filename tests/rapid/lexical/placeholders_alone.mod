! RAPID Kernel, Placeholders: * stands for a position that is not taught yet.
MODULE placeholders_alone
  PROC main()
  ENDPROC

  PROC unfinished()
    MoveC *,*,v100,fine,tool0;          ! warning: E148, E148
    move_to *;                          ! warning: E148
    move_to target:=<EXP>;              ! warning: E148
  ENDPROC

  PROC move_to(robtarget target)
  ENDPROC
ENDMODULE
