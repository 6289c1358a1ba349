MODULE example
  PROC main()
    TEST reg1
    CASE 1:
      TPWrite "left";
    CASE 2:
      TPWrite "right";
    ENDTEST
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS num limit:=1;
  VAR num other:=1;
  PROC main()
    TEST reg1
    CASE limit:
      TPWrite "limit";
    CASE other,1:
      TPWrite "other";
    ENDTEST
    TEST reg1
    CASE 1:
      TPWrite "again";
    ENDTEST
  ENDPROC
ENDMODULE
