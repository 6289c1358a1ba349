MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR IF ERRNO=ERR_DIVZERO THEN
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num parts;
  PROC main()
    WaitTime 1/parts;
    quietly;
  ERROR
    TPWrite "No parts";
    TRYNEXT;
  ENDPROC
  PROC quietly()
    WaitTime 1/parts;
  ERROR (ERR_DIVZERO)
    TRYNEXT;
  ENDPROC
ENDMODULE
