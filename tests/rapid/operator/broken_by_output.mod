! RAPID Instructions, TPReadFK: an output ends the question; here a trap sets it.
MODULE broken_by_output
  VAR signaldo stop_asking;
  VAR intnum later;

  PROC main()
    VAR num key:=3;
    VAR errnum broke;
    AliasIO "doStop",stop_asking;
    CONNECT later WITH stop_it;
    ITimer\Single,1.5,later;
    TPReadFK key,"?","a","b","c","d","e"\DOBreak:=stop_asking\BreakFlag:=broke; ! -> ?
    TPWrite ValToStr(broke=ERR_TP_DOBREAK); ! -> TRUE
    TPWrite ValToStr(key);                  ! -> 3
  ENDPROC

  TRAP stop_it
    SetDO stop_asking,1;
  ENDTRAP
ENDMODULE
