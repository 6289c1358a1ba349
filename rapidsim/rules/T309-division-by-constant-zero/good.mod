MODULE example
  CONST num parts:=4;
  PROC main()
    WaitTime 10/parts;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST num parts:=4;
  VAR num count:=0;
  PERS num shared:=0;
  PROC main()
    WaitTime 1/parts+1/(parts-3);
    WaitTime 7 DIV parts+7 MOD parts;
    IF count>0 WaitTime 1/count+1/shared;
  ENDPROC
ENDMODULE
