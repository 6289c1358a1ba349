MODULE example
  PROC main()
    TPErase;
    VAR num count:=3; ! found
    Incr count;
  ENDPROC
ENDMODULE
