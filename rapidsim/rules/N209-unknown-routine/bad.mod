MODULE example
  PROC main()
    OpenVacuumGripper; ! found
  ENDPROC
ENDMODULE
