! RAPID Instructions, SetDO: \SDelay is 2000 s at most.
MODULE delay_too_long
  VAR signaldo doLamp;

  PROC main()
    AliasIO "doLamp",doLamp;
    SetDO \SDelay:=2000,doLamp,1;
    SetDO \SDelay:=2000.5,doLamp,1;
    TPWrite "next";                     ! -> next
  ERROR
    TPWrite "argument "\Bool:=ERRNO=ERR_ARGVALERR;          ! -> argument TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
