MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR TRYNEXT; ! found
  ENDPROC
ENDMODULE
! ---
MODULE other_ways
  VAR num parts;
  PROC main()
    leaves;
    does_nothing;
    others_by_else;
    others_by_default;
    others_behind;
  ENDPROC
  PROC leaves()
    WaitTime 1/parts;
  ERROR
    RETURN; ! found
  ENDPROC
  PROC does_nothing()
    WaitTime 1/parts;
  ERROR ! found
  ENDPROC
  PROC others_by_else()
    WaitTime 1/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      parts:=1;
      RETRY;
    ELSE
      TRYNEXT; ! found
    ENDIF
  ENDPROC
  PROC others_by_default()
    WaitTime 1/parts;
  ERROR
    TEST ERRNO
    CASE ERR_DIVZERO:
      parts:=1;
      RETRY;
    DEFAULT:
      RETURN; ! found
    ENDTEST
  ENDPROC
  PROC others_behind()
    WaitTime 1/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      parts:=1;
      RETRY;
    ENDIF
    TRYNEXT; ! found
  ENDPROC
ENDMODULE
