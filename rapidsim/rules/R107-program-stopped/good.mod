MODULE example
  PROC main()
    TPWrite "Change the gripper";
    TPWrite "Gripper changed";
  ENDPROC
ENDMODULE
