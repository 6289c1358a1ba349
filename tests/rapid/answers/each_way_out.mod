! RAPID Overview, Error recovery: what a clause does about an error is what becomes of it.
MODULE each_way_out
  VAR num zero;
  VAR num tries;
  VAR num list{3};

  PROC main()
    retries;
    skips;
    leaves;
    falls;
    passes_on;
    TPWrite "end";                      ! -> end
  ERROR
    TRYNEXT;
  ENDPROC

  PROC retries()
    WaitUntil tries>2\MaxTime:=0.1;     ! answered: ERR_WAIT_MAXTIME retried by retries 3 times
  ERROR
    tries:=tries+1;
    RETRY;
  ENDPROC

  PROC skips()
    zero:=1/zero;                       ! answered: ERR_DIVZERO next by skips
  ERROR
    IF ERRNO=ERR_DIVZERO TRYNEXT;
  ENDPROC

  PROC leaves()
    zero:=1/zero;                       ! answered: ERR_DIVZERO returned by leaves
  ERROR
    RETURN;
  ENDPROC

  PROC falls()
    tries:=list{tries+1};               ! answered: ERR_OUTOFBND fell through by falls
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      TRYNEXT;
    ENDIF
  ENDPROC

  PROC passes_on()
    RAISE 7;
    ! answered: 7 raised by passes_on ! answered: 7 next by main
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
