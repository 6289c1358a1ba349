! RAPID Functions, UIDnumEntry: limits are checked before anybody is asked; nobody there is a time-out.
MODULE double_number
  PROC main()
    VAR dnum answer;
    answer:=UIDnumEntry(\Header:="h"\Message:="m"\InitValue:=5\MinValue:=10\MaxTime:=1);
    answer:=UIDnumEntry(\Header:="h"\Message:="m"\MinValue:=2\MaxValue:=1\MaxTime:=1);
    answer:=UIDnumEntry(\Header:="h"\Message:="m"\InitValue:=1.5\AsInteger\MaxTime:=1);
    answer:=UIDnumEntry(\Header:="h"\Message:="m"\InitValue:=4294967295\MaxTime:=1); ! -> h / m
  ERROR
    TPWrite error_name(ERRNO);  ! -> start ! -> limits ! -> whole ! -> time
    TRYNEXT;
  ENDPROC

  FUNC string error_name(errnum number)
    TEST number
    CASE ERR_UI_INITVALUE:
      RETURN "start";
    CASE ERR_UI_MAXMIN:
      RETURN "limits";
    CASE ERR_UI_NOTINT:
      RETURN "whole";
    CASE ERR_TP_MAXTIME:
      RETURN "time";
    DEFAULT:
      RETURN "another";
    ENDTEST
  ENDFUNC
ENDMODULE
