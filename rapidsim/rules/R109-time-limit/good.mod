MODULE example
  PROC main()
    FOR part FROM 1 TO 10 DO
      WaitTime 1;
    ENDFOR
  ENDPROC
ENDMODULE
