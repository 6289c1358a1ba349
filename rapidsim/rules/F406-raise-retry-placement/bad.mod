MODULE example
  PROC main()
    VAR num parts:=0;
    IF parts=0 RETRY; ! found
  ENDPROC
ENDMODULE
