! RAPID Instructions, TPReadFK: RETRY asks again, four times at most.
MODULE key_timeout_again
  PROC main()
    VAR num key;
    TPReadFK key,"?","a","b","c","d","e"\MaxTime:=2; ! -> ? ! -> ? ! -> ? ! -> ? ! -> ?
    ! stops: 4 retries did not help: TPReadFK: no answer within 2 s (ERR_EXCRTYMAX)
  ERROR
    RETRY;
  ENDPROC
ENDMODULE
