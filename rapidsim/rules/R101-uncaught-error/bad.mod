MODULE example
  PROC main()
    VAR num parts:=0;
    VAR num each;
    each:=100/parts; ! found
  ENDPROC
ENDMODULE
