! RAPID Overview, Multitasking: an error that a background task handles is its own affair.
MODULE robot
  PERS num turns:=0;
  VAR intnum told;

  PROC main()
    CONNECT told WITH tell;
    IError COMMON_ERR,TYPE_WARN,told;
    WaitUntil turns>=4\MaxTime:=10;
    TPWrite "turns "\Num:=turns;             ! -> turns 4
  ENDPROC

  TRAP tell
    VAR trapdata data;
    VAR errdomain domain;
    VAR num number;
    VAR errtype type;
    VAR string title;
    GetTrapData data;
    ReadErrData data,domain,number,type\Title:=title;
    TPWrite title+" "\Bool:=type=TYPE_WARN;  ! -> Low TRUE
  ENDTRAP
ENDMODULE
