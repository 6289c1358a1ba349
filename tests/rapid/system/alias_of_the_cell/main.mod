! RAPID Instructions, AliasIO: connects variables of the program; what the configuration defines keeps its name.
MODULE alias_of_the_cell
  VAR signaldo lamp;

  PROC main()
    AliasIO "doGun",lamp;
    SetDO lamp,1;
    TPWrite ValToStr(DOutput(doGun));       ! -> 1
    AliasIO doGun,doLamp;
    AliasIO "doGone",lamp;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_ALIASIO_DEF);
    ! -> TRUE
    ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
