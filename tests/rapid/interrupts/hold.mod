! RAPID Instructions, ISleep and IDisable: asleep they are lost, disabled they are kept.
MODULE hold
  VAR intnum tick;
  VAR num ticks;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer 1,tick;
    ISleep tick;
    WaitTime 2.5;
    TPWrite "asleep: "\Num:=ticks;      ! -> asleep: 0
    IWatch tick;
    IDisable;
    WaitTime 1;
    TPWrite "disabled: "\Num:=ticks;    ! -> disabled: 0
    IEnable;
    WaitTime 0.1;
    TPWrite "enabled: "\Num:=ticks;     ! -> enabled: 1
  ENDPROC

  TRAP on_tick
    ticks:=ticks+1;
  ENDTRAP
ENDMODULE
