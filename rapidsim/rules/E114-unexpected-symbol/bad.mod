MODULE example
  PROC main()
    SetDO doGrip,,1; ! found
  ENDPROC
ENDMODULE
