MODULE example
  VAR intnum part_seen;
  PROC main()
    CONNECT part_seen WITH count; ! found
  ENDPROC
  PROC count()
  ENDPROC
ENDMODULE
