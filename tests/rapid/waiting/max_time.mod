! RAPID Instructions, WaitUntil: \MaxTime ends the wait with an error, with \TimeFlag by that alone.
MODULE max_time
  VAR signaldi diNever;
  VAR clock watch;
  VAR num looks;

  PROC main()
    VAR bool late;
    AliasIO "diNever",diNever;
    ClkStart watch;
    WaitUntil diNever=1\MaxTime:=1.5\TimeFlag:=late;
    TPWrite ValToStr(late);                           ! -> TRUE
    TPWrite ValToStr(ClkRead(watch));                 ! -> 1.5
    WaitDI diNever,1\MaxTime:=0.5;
    TPWrite ValToStr(ClkRead(watch));                 ! -> 2
    WaitDI diNever,0\MaxTime:=0.5\TimeFlag:=late;
    TPWrite ValToStr(late);                           ! -> FALSE
    WaitUntil looked()\MaxTime:=1\TimeFlag:=late\PollRate:=0.2;
    TPWrite ValToStr(looks);                          ! -> 6
    looks:=0;
    WaitUntil looked()\MaxTime:=0.38\TimeFlag:=late\PollRate:=0.001;
    TPWrite ValToStr(looks);                          ! -> 11
  ERROR
    TPWrite ValToStr(ERRNO=ERR_WAIT_MAXTIME);         ! -> TRUE
    TRYNEXT;
  ENDPROC

  FUNC bool looked()
    looks:=looks+1;
    RETURN FALSE;
  ENDFUNC
ENDMODULE
