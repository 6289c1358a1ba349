! RAPID Instructions, TPReadNum: nobody answers within \MaxTime, and \BreakFlag says so.
MODULE number_timeout
  PROC main()
    VAR num parts:=7;
    VAR errnum broke;
    VAR clock watch;
    ClkStart watch;
    TPReadNum parts,"How many?"\MaxTime:=3\BreakFlag:=broke; ! -> How many?
    TPWrite ValToStr(broke=ERR_TP_MAXTIME); ! -> TRUE
    TPWrite ValToStr(parts);                ! -> 7
    TPWrite ValToStr(ClkRead(watch));       ! -> 3
  ENDPROC
ENDMODULE
