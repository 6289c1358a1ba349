! Field practice, libraries: a stub module of the station declares what the repository lacks.
MODULE stub_of_a_library
  PROC main()
    Gripper_Close 20;
    TPWrite ValToStr(Gripper_Width());      ! -> 40
  ENDPROC
ENDMODULE
