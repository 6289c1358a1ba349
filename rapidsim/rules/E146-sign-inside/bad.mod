MODULE example
  PROC main()
    reg1:=reg2*-2; ! found
  ENDPROC
ENDMODULE
