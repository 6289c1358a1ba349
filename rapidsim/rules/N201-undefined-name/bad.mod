MODULE example
  VAR num parts:=3;
  PROC main()
    prats:=parts+1; ! found
  ENDPROC
ENDMODULE
