MODULE example
  VAR num parts;
  PROC main()
    parts:=100/parts;
  ERROR IF ERRNO=1074 TRYNEXT; ! found
  ENDPROC
ENDMODULE
