MODULE example
  VAR clock first;
  VAR clock second;
  PROC main()
    second:=first; ! found
  ENDPROC
ENDMODULE
