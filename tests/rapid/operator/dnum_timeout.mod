! RAPID Instructions, TPReadDnum: as TPReadNum.
MODULE dnum_timeout
  PROC main()
    VAR dnum serial:=123456789012;
    VAR errnum broke;
    TPReadDnum serial,"Number?"\MaxTime:=1\BreakFlag:=broke; ! -> Number?
    TPWrite ValToStr(serial);               ! -> 123456789012
    TPWrite ValToStr(broke=ERR_TP_MAXTIME); ! -> TRUE
  ENDPROC
ENDMODULE
