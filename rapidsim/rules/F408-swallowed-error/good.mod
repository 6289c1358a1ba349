MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR IF ERRNO=ERR_DIVZERO THEN
      TRYNEXT;
    ELSE
      RAISE;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num parts;
  VAR bool failed;
  PROC main()
    WaitTime 1/parts;
    quietly;
    others_told;
    flagged;
    TPWrite ""\Num:=stand_in();
  ERROR
    TPWrite "No parts";
    TRYNEXT;
  ENDPROC
  PROC quietly()
    WaitTime 1/parts;
  ERROR (ERR_DIVZERO)
    TRYNEXT;
  ENDPROC
  PROC others_told()
    WaitTime 1/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      TRYNEXT;
    ELSE
      TPWrite "Unexpected";
      TRYNEXT;
    ENDIF
  ENDPROC
  PROC flagged()
    WaitTime 1/parts;
  ERROR
    failed:=TRUE;
    RETURN;
  ENDPROC
  FUNC num stand_in()
    RETURN 1/parts;
  ERROR
    RETURN -1;
  ENDFUNC
ENDMODULE
