MODULE example
  VAR num part:=3;
  PROC main()
    TEST part
    CASE 1:
      WaitTime 1;
    DEFAULT:
      TPWrite "Unknown part "\Num:=part;
      Stop;
    ENDTEST
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num part:=1;
  PROC main()
    TEST part
    CASE 1,2:
      WaitTime 1;
    DEFAULT:
    ENDTEST
  ENDPROC
ENDMODULE
