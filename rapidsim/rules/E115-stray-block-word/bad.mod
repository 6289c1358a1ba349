MODULE example
  PROC main()
    Stop;
    ENDIF ! found
  ENDPROC
ENDMODULE
