! Field practice, the gripper of the IRB 14000: each arm has a gripper of its own.
MODULE left
  PROC main()
    TPWrite ValToStr(g_GetPos());           ! -> 0
    g_MoveTo 20;
    g_GripIn;                               ! warning: R104
    TPWrite ValToStr(g_GetPos());           ! -> 0
  ENDPROC
ENDMODULE
