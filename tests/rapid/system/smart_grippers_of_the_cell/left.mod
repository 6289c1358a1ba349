MODULE left
  PROC main()
    ! The other arm has a gripper of its own.
    TPWrite ValToStr(g_GetPos());           ! -> 0
    g_MoveTo 20;
    g_GripIn;                               ! warning: R104
    TPWrite ValToStr(g_GetPos());           ! -> 0
  ENDPROC
ENDMODULE
