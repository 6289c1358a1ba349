! RAPID Functions, UINumEntry: limits and start values that contradict each other.
MODULE start_values_wrong
  PROC main()
    VAR num n;
    VAR dnum d;
    VAR btnres b;
    CONST string names{3}:=["a","b","c"];
    CONST listitem list{2}:=[["","one"],["","two"]];
    n:=UINumEntry(\Header:="h"\Message:="m"\InitValue:=5\MinValue:=6\MaxValue:=9\MaxTime:=1);
    n:=UINumEntry(\InitValue:=7\MinValue:=9\MaxValue:=6\MaxTime:=1);
    n:=UINumEntry(\InitValue:=5.5\MinValue:=1\MaxValue:=6\AsInteger\MaxTime:=1);
    n:=UINumEntry(\MaxTime:=1);             ! ->
    b:=UIMessageBox(\Message:="m"\BtnArray:=names\MaxTime:=1); ! -> m
    n:=UIListView(\Result:=b\Header:="h",list\Buttons:=btnOKCancel\MaxTime:=1); ! -> h
    d:=UIDnumEntry(\InitValue:=5\MinValue:=6\MaxValue:=9\MaxTime:=1);
    UIMsgBox "?"\Buttons:=btnYesNo\MaxTime:=1; ! -> ?
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_UI_INITVALUE:
      TPWrite "init";                       ! -> init ! -> init
    CASE ERR_UI_MAXMIN:
      TPWrite "max min";                    ! -> max min
    CASE ERR_UI_NOTINT:
      TPWrite "integer";                    ! -> integer
    CASE ERR_TP_MAXTIME:
      TPWrite "time";                       ! -> time ! -> time ! -> time ! -> time
    DEFAULT:
      TPWrite "other";
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
