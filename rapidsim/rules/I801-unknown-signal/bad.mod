MODULE example
  PROC main()
    SetDO doGripper,1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE connected
  VAR signaldo glue;
  PROC main()
    AliasIO doGlue,glue; ! found
    Set glue;
  ENDPROC
ENDMODULE
