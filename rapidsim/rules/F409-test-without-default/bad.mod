MODULE example
  VAR num part:=3;
  PROC main()
    TEST part ! found
    CASE 1:
      WaitTime 1;
    ENDTEST
  ENDPROC
ENDMODULE
