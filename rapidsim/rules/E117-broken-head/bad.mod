MODULE example
  PROC main()
    FOR i=1 TO 3 DO ! found
      Stop;
    ENDFOR
  ENDPROC
ENDMODULE
