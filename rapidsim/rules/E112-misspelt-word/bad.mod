MODULE example
  PROC main()
    IF DInput(di1)=1 THNE ! found
      Stop;
    ENDIF
  ENDPROC
ENDMODULE
