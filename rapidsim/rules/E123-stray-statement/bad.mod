MODULE example
  PROC main()
    Stop;
  ENDPROC
  SetDO doGrip,1; ! found
ENDMODULE
