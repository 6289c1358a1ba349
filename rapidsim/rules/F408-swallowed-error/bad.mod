MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR TRYNEXT; ! found
  ENDPROC
ENDMODULE
