MODULE example
  VAR num grid{3,4};
  PROC main()
    grid{2}:=5; ! found
  ENDPROC
ENDMODULE
