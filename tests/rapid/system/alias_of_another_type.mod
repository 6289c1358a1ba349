! RAPID Instructions, AliasIO: a signal variable can mean signals of its own type only.
MODULE alias_of_another_type
  VAR signaldi sensor;
  VAR signaldo valve;
  VAR signaldo another;

  PROC main()
    AliasIO "doValve",valve;
    AliasIO valve,another;
    Set another;
    TPWrite ValToStr(DOutput(valve));       ! -> 1
    AliasIO valve,sensor;
    TPWrite "never";
  ERROR
    TPWrite "type "\Bool:=ERRNO=ERR_ALIASIO_TYPE; ! -> type TRUE
    EXIT; ! ends: stopped ! note: R107
  ENDPROC
ENDMODULE
