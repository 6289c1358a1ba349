MODULE example
  PROC main()
    VAR num x;
    x:=1 ! found
    Stop;
  ENDPROC
ENDMODULE
