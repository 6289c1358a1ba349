! RAPID Instructions, TPReadNum: an input ends the question, and \DIPassive waits for its fall.
MODULE broken_by_input
  VAR signaldi ready;

  PROC main()
    VAR num n;
    VAR errnum broke;
    VAR clock watch;
    AliasIO "diReady",ready;
    ClkStart watch;
    TPReadNum n,"first?"\DIBreak:=ready\BreakFlag:=broke; ! -> first?
    TPWrite ValToStr(broke=ERR_TP_DIBREAK); ! -> TRUE
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 2
    TPReadNum n,"second?"\DIBreak:=ready\DIPassive\BreakFlag:=broke; ! -> second?
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 5
    TPReadNum n,"third?"\MaxTime:=1\DIBreak:=ready\BreakFlag:=broke; ! -> third?
    TPWrite ValToStr(broke=ERR_TP_MAXTIME); ! -> TRUE
  ENDPROC
ENDMODULE
