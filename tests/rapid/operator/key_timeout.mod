! RAPID Instructions, TPReadFK: without \BreakFlag the time-out is an error for the ERROR clause.
MODULE key_timeout
  PROC main()
    VAR num key;
    TPReadFK key,"Go on?",stEmpty,"Yes",stEmpty,stEmpty,"No"\MaxTime:=2; ! -> Go on?
    TPWrite "behind";                       ! -> behind
  ERROR
    IF ERRNO=ERR_TP_MAXTIME THEN
      TPWrite "time is up";                 ! -> time is up
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
