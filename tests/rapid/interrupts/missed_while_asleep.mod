! RAPID Instructions, ISleep: what happens while an interrupt sleeps is lost, with IDisable it waits.
MODULE missed_while_asleep
  VAR intnum change;
  VAR num times;
  PERS num value:=0;

  PROC main()
    CONNECT change WITH on_change;
    IPers value,change;
    ISleep change;
    value:=1;
    WaitTime 0.1;
    IWatch change;
    WaitTime 0.1;
    TPWrite ValToStr(times);                ! -> 0
    IDisable;
    value:=2;
    value:=3;
    WaitTime 0.1;
    TPWrite ValToStr(times);                ! -> 0
    IEnable;
    TPWrite ValToStr(times);                ! -> 2
  ENDPROC

  TRAP on_change
    Incr times;
  ENDTRAP
ENDMODULE
