MODULE example
  PROC main()
    if TRUE then ! found
    endif ! found
  ENDPROC
ENDMODULE
