MODULE example
  PROC main()
    FOR i IN RANGE 1 3 DO ! found
      Stop;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE 1_first ! found
ENDMODULE
MODULE 2_second ! found
ENDMODULE
