MODULE example
  PROC main()
    IF DInput(di1)=1 THEN
      Stop; ! found
  ENDPROC
ENDMODULE
