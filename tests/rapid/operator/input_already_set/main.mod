! RAPID Instructions, TPReadNum: an input that is set already ends the question before it is asked.
MODULE input_already_set
  VAR signaldi ready;

  PROC main()
    VAR num n:=4;
    VAR errnum broke;
    AliasIO "diReady",ready;
    TPReadNum n,"never asked"\DIBreak:=ready\BreakFlag:=broke;
    TPWrite ValToStr(broke=ERR_TP_DIBREAK); ! -> TRUE
    TPReadNum n,"nor this"\DIBreak:=ready;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_TP_DIBREAK); ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
