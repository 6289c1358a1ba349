MODULE example
  VAR num parts{3};
  VAR num used:=0;
  PROC main()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      used:=1;
      RETRY;
    ELSE
      RAISE;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num parts{3};
  VAR num used;
  VAR bool failed;
  PROC main()
    told_behind;
    flagged;
    stops;
    listed;
    awaits;
    TPWrite ""\Num:=of_a_function();
  ENDPROC
  PROC told_behind()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO TRYNEXT;
    TPWrite "unexpected";
  ENDPROC
  PROC flagged()
    parts{used}:=10/used;
  ERROR
    failed:=TRUE;
    IF ERRNO=ERR_DIVZERO TRYNEXT;
  ENDPROC
  PROC stops()
    parts{used}:=10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO TRYNEXT;
    Stop;
  ENDPROC
  PROC listed()
    parts{used}:=10/used;
  ERROR (ERR_DIVZERO)
    IF ERRNO=ERR_DIVZERO TRYNEXT;
  ENDPROC
  PROC awaits()
    WaitUntil used>3\MaxTime:=2;
    TPWrite "there";
  ERROR
    IF ERRNO=ERR_WAIT_MAXTIME THEN
      TPWrite "late";
    ENDIF
  ENDPROC
  FUNC num of_a_function()
    RETURN 10/used;
  ERROR
    IF ERRNO=ERR_DIVZERO RETURN 0;
  ENDFUNC
ENDMODULE
