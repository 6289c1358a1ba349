MODULE late_binding
  VAR num station:=1;
  CONST string prefix:="proc_";
  PROC main()
    %"proc_"+NumToStr(station,0)%;
    %prefix+"2"% 7;
    CallByVar "proc_",station;
  ERROR
    IF ERRNO=ERR_REFUNKPRC OR ERRNO=ERR_CALLPROC THEN
      TPWrite "no such station";
      TRYNEXT;
    ENDIF
  ENDPROC
  PROC proc_1()
    WaitTime 0.1;
  ENDPROC
  PROC proc_2(num x)
    WaitTime x/10;
  ENDPROC
ENDMODULE
