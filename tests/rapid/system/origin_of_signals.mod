! RAPID Functions, GetSignalOrigin: a signal of the configuration, an alias, or neither.
MODULE origin_of_signals
  VAR signaldi other_name;
  VAR signaldo nothing;

  PROC main()
    VAR string name;
    TPWrite ValToStr(GetSignalOrigin(nothing,name)=SIGORIG_NONE); ! -> TRUE
    AliasIO "diPart",other_name;
    TPWrite ValToStr(GetSignalOrigin(other_name,name)=SIGORIG_ALIAS); ! -> TRUE
    TPWrite name;                           ! -> diPart
  ENDPROC
ENDMODULE
