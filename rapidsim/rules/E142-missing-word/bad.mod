MODULE example
  PROC main()
    WHILE reg1<5 ! found
      Incr reg1;
    ENDWHILE
  ENDPROC
ENDMODULE
