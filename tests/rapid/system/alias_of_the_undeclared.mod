! RAPID Instructions, AliasIO: a signal that nothing declares is of the type of the variable it is connected with.
MODULE alias_of_the_undeclared
  VAR signaldo lamp;
  VAR signalgo code;
  VAR signalai level;

  PROC main()
    AliasIO doLamp,lamp;                    ! warning: I801
    AliasIO Line_code,code;                  ! warning: I801
    AliasIO pressure,level;                 ! warning: I801
    Set lamp;
    SetGO code,6;
    TPWrite ValToStr(DOutput(doLamp));      ! -> 1
    TPWrite ValToStr(GOutput(Line_code));   ! -> 6
    TPWrite ValToStr(level);                ! -> 0
  ENDPROC
ENDMODULE
