! RAPID Kernel, Error recovery: RETRY decides an IF, TEST or WHILE again from its beginning.
MODULE conditions
  VAR num divisor;
  VAR num turns;

  PROC main()
    IF 6/divisor=3 THEN
      TPWrite "half";                     ! -> half
    ELSE
      TPWrite "other";
    ENDIF
    divisor:=0;
    IF 6/divisor=1 THEN
      TPWrite "never";
    ELSEIF 6/divisor=6 THEN
      TPWrite "never";
    ELSE
      TPWrite "neither";                  ! -> neither
    ENDIF
    IF 6/divisor=1 THEN
      TPWrite "never";
    ELSE
      TPWrite "nor without an error";     ! -> nor without an error
    ENDIF
    divisor:=0;
    TEST 6/divisor
    CASE 3:
      TPWrite "case";                     ! -> case
    ENDTEST
    divisor:=0;
    WHILE 6/divisor>turns DO
      turns:=turns+1;
      IF turns=2 divisor:=0;
    ENDWHILE
    TPWrite "turns "\Num:=turns;          ! -> turns 3
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      divisor:=2;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
