MODULE example
  PROC main()
    PERS num parts:=0; ! found
    parts:=parts+1;
  ENDPROC
ENDMODULE
