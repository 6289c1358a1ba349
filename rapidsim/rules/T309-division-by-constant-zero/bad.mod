MODULE example
  CONST num parts:=0;
  PROC main()
    WaitTime 10/parts; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST num parts:=0;
  CONST num pairs:=parts*2;
  PROC main()
    WaitTime 10/parts;                ! found
    WaitTime 7 DIV 0;                 ! found
    WaitTime 7 MOD (pairs);           ! found
    WaitTime 7/(3-3);                 ! found
  ENDPROC
ENDMODULE
