MODULE example
  PROC main()
    VAR num count:=3;
  ENDPROC
ENDMODULE
