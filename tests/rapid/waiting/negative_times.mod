! RAPID Instructions, WaitTime: a negative time is an error of its argument.
MODULE negative_times
  PROC main()
    VAR clock c;
    ClkStart c;
    WaitTime -1;
    WaitTime\InPos,0;
    WaitUntil TRUE\MaxTime:=0.1;
    WaitUntil FALSE\MaxTime:=-1;
    TPWrite ValToStr(ClkRead(c));           ! -> 0
  ERROR
    IF ERRNO=ERR_ARGVALERR TPWrite "value"; ! -> value
    IF ERRNO=ERR_WAIT_MAXTIME TPWrite "time"; ! -> time
    TRYNEXT;
  ENDPROC
ENDMODULE
