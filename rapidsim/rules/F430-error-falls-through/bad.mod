MODULE example
  VAR num parts{3};
  VAR num used:=0;
  PROC main()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN ! found
      used:=1;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE other_shapes
  VAR num parts{3};
  VAR num used;
  VAR num tries;
  PROC main()
    by_test;
    by_two;
    an_empty_else;
    after_the_last_retry;
    a_text_for_all;
  ENDPROC
  PROC by_test()
    parts{used}:=10/used;
  ERROR
    TEST ERRNO ! found
    CASE ERR_DIVZERO:
      TRYNEXT;
    CASE ERR_OUTOFBND:
      used:=1;
      RETRY;
    ENDTEST
  ENDPROC
  PROC by_two()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO TRYNEXT;
    IF ERRNO=ERR_OUTOFBND TRYNEXT; ! found
  ENDPROC
  PROC an_empty_else()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN ! found
      TRYNEXT;
    ELSE
      ! no recovery of the others
    ENDIF
  ENDPROC
  PROC after_the_last_retry()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN ! found
      IF tries<3 THEN
        tries:=tries+1;
        RETRY;
      ENDIF
    ELSE
      RAISE;
    ENDIF
  ENDPROC
  PROC a_text_for_all()
    parts{used}:=10/used;
  ERROR
    TPWrite "failed";
    IF ERRNO=ERR_DIVZERO TRYNEXT; ! found
  ENDPROC
ENDMODULE
