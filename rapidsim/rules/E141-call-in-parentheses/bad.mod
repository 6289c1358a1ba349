MODULE example
  PROC main()
    wait_for(1,2); ! found
  ENDPROC
  PROC wait_for(num part,num seconds)
  ENDPROC
ENDMODULE
