MODULE example
  PROC main()
    FOR i FROM 1 TO 3 DO
      IF i=2 CONTINUE; ! found
      TPWrite ValToStr(i);
    ENDFOR
  ENDPROC
ENDMODULE
