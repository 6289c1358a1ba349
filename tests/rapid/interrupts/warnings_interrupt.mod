! RAPID Instructions, IError: a warning that the program logs itself; ReadErrData tells what it was.
MODULE warnings_interrupt
  VAR intnum logged;

  PROC main()
    CONNECT logged WITH on_log;
    IError COMMON_ERR,TYPE_WARN,logged;
    ErrWrite\I,"Pump","as always";          ! -> information Pump: as always
    ErrWrite\W,"Pump","too hot";            ! -> warning Pump: too hot
    WaitTime 0.1;
    TPWrite "end";                          ! -> end
  ENDPROC

  TRAP on_log
    VAR trapdata what;
    VAR errdomain domain;
    VAR num number;
    VAR errtype kind;
    VAR string title;
    VAR string text;
    GetTrapData what;
    ReadErrData what,domain,number,kind\Title:=title\Str1:=text;
    TPWrite title+", "+text+" "\Bool:=kind=TYPE_WARN;    ! -> Pump, too hot TRUE
  ENDTRAP
ENDMODULE
