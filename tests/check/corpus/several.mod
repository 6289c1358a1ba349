MODULE first
  PROC main()
    second_part;
  ENDPROC
ENDMODULE

MODULE second(READONLY)
  PROC second_part()
    WaitTime 0.1;
  ENDPROC
ENDMODULE
