! RAPID Functions, StrDigCalc: errors of numbers that are written in digits; DnumToNum of whole ones.
MODULE digits
  PROC main()
    VAR string s;
    VAR num n;
    VAR dnum beyond:=8388609;
    TPWrite StrDigCalc("4294967294",OpAdd,"1"); ! -> 4294967295
    s:=StrDigCalc("4294967295",OpAdd,"1");
    s:=StrDigCalc("1",OpSub,"2");
    s:=StrDigCalc("1",OpDiv,"0");
    s:=StrDigCalc("1",OpMod,"0");
    s:=StrDigCalc("1.5",OpAdd,"1");
    s:=StrDigCalc("4294967296",OpSub,"1");
    n:=DnumToNum(beyond);
    n:=DnumToNum(beyond\Integer);
    n:=DnumToNum(0.5\Integer);
    n:=DnumToNum(1E39);
  ERROR
    TPWrite error_name(ERRNO);
    ! -> overflow ! -> negative ! -> division ! -> no number ! -> no number ! -> too large
    ! -> argument ! -> no number ! -> limit
    TRYNEXT;
  ENDPROC

  FUNC string error_name(errnum number)
    TEST number
    CASE ERR_CALC_OVERFLOW:
      RETURN "overflow";
    CASE ERR_CALC_NEG:
      RETURN "negative";
    CASE ERR_CALC_DIVZERO:
      RETURN "division";
    CASE ERR_INT_NOTVAL:
      RETURN "no number";
    CASE ERR_INT_MAXVAL:
      RETURN "too large";
    CASE ERR_ARGVALERR:
      RETURN "argument";
    CASE ERR_NUM_LIMIT:
      RETURN "limit";
    DEFAULT:
      RETURN "another";
    ENDTEST
  ENDFUNC
ENDMODULE
