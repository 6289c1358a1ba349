MODULE example
  PROC main()
    TEST reg1
    CASE 1 TO 3: ! found
      TPErase;
    ENDTEST
  ENDPROC
ENDMODULE
