! RAPID Functions, GetSignalOrigin: a signal of the configuration, an alias, or neither.
MODULE origin_of_signals
  VAR signaldi alias;
  VAR signaldo nothing;

  PROC main()
    VAR string name;
    TPWrite ValToStr(GetSignalOrigin(nothing,name)=SIGORIG_NONE); ! -> TRUE
    AliasIO "diPart",alias;
    TPWrite ValToStr(GetSignalOrigin(alias,name)=SIGORIG_ALIAS); ! -> TRUE
    TPWrite name;                           ! -> diPart
  ENDPROC
ENDMODULE
