! Field practice, the gripper of the IRB 14000: a program's own routine of the name is meant.
MODULE smart_gripper_of_its_own
  PROC main()
    g_GripIn;
    g_GripOut;
    TPWrite ValToStr(g_GetPos());           ! -> 7
  ENDPROC

  PROC g_gripIn()
    TPWrite "closes";                       ! -> closes
  ENDPROC

  PROC g_gripOut()
    TPWrite "opens";                        ! -> opens
  ENDPROC

  FUNC num g_GetPos()
    RETURN 7;
  ENDFUNC
ENDMODULE
