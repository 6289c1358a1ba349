! RAPID Instructions, TPReadNum: \PersBoolBreak ends the question when a trap or a task sets it.
MODULE broken_by_persistent
  PERS bool enough:=FALSE;
  VAR intnum later;

  PROC main()
    VAR num n;
    VAR errnum broke;
    enough:=FALSE;
    CONNECT later WITH stop_it;
    ITimer\Single,1.5,later;
    TPReadNum n,"?"\PersBoolBreak:=enough\BreakFlag:=broke; ! -> ?
    TPWrite ValToStr(broke=ERR_TP_PERSBOOLBREAK); ! -> TRUE
    TPReadNum n,"??"\PersBoolBreak:=enough\PersBoolPassive\MaxTime:=1\BreakFlag:=broke; ! -> ??
    TPWrite ValToStr(broke=ERR_TP_MAXTIME); ! -> TRUE
  ENDPROC

  TRAP stop_it
    enough:=TRUE;
  ENDTRAP
ENDMODULE
