MODULE example
  VAR num heights{3};
  PROC main()
    heights{4}:=10; ! found
  ENDPROC
ENDMODULE
