! RAPID Functions, UINumTune: the answer is a number within limits; nobody there leaves the first.
MODULE numbers_tuned
  PROC main()
    VAR errnum broke;
    TPWrite ValToStr(UINumTune(\Message:="gap",2.5,0.1\MinValue:=0\MaxValue:=5\MaxTime:=1\BreakFlag:=broke)); ! -> gap ! -> 2.5
    TPWrite ValToStr(UIDnumTune(\Message:="wide",2.5,0.1\MaxTime:=1\BreakFlag:=broke)); ! -> wide ! -> 2.5
    TPWrite ValToStr(UINumTune(\Message:="bad",9,1\MinValue:=0\MaxValue:=5\MaxTime:=1));
  ERROR
    TPWrite ValToStr(ERRNO=ERR_UI_INITVALUE); ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
