! RAPID Instructions, PulseDO: a pulse takes from 0.001 s to 2000 s.
MODULE pulse_too_long
  VAR signaldo doLamp;

  PROC main()
    AliasIO "doLamp",doLamp;
    PulseDO \PLength:=2001,doLamp;
  ERROR
    TPWrite "argument "\Bool:=ERRNO=ERR_ARGVALERR;          ! -> argument TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
