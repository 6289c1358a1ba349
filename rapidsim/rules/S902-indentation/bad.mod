MODULE example
  PROC main()
    WaitTime 1;
      WaitTime 2; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PROC main()
    WaitTime 1;
      WaitTime 2;                              ! found
    IF TRUE THEN
      WaitTime 3;
     WaitTime 4;                               ! found
    ENDIF
  ENDPROC
ENDMODULE
