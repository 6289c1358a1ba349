MODULE example
  PROC main()
    TPWrite "Change the gripper";
    Stop; ! found
    TPWrite "Gripper changed";
  ENDPROC
ENDMODULE
