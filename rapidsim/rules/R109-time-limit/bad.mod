MODULE example
  PROC main()
    WHILE TRUE DO
      WaitTime 1; ! found
    ENDWHILE
  ENDPROC
ENDMODULE
