! RAPID Instructions, WaitUntil: a clause may wait again after \MaxTime.
MODULE time_out_and_retry
  VAR bool ready;
  VAR num tries;
  VAR clock watch;

  PROC main()
    ClkStart watch;
    WaitUntil ready\MaxTime:=1;
    TPWrite "ready after "\Num:=ClkRead(watch);  ! -> ready after 2
  ERROR
    IF ERRNO=ERR_WAIT_MAXTIME THEN
      Incr tries;
      IF tries=2 ready:=TRUE;
      RETRY;
    ENDIF
  ENDPROC
ENDMODULE
