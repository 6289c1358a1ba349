MODULE example
  VAR num a{3};
  PROC main()
    a{1}:=a[2]; ! found
  ENDPROC
ENDMODULE
