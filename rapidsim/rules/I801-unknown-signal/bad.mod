MODULE example
  PROC main()
    SetDO doGripper,1; ! found
  ENDPROC
ENDMODULE
