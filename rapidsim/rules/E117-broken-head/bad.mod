MODULE example
  PROC main()
    FOR i=1 TO 3 DO ! found
      Stop;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE 1_first ! found
ENDMODULE
MODULE 2_second ! found
ENDMODULE
