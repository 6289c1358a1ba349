MODULE example
  PROC main()
    VAR num x;
    x:=(1 2) 3; ! found
  ENDPROC
ENDMODULE
