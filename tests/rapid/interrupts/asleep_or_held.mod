! RAPID Instructions, IDisable, ISleep: what is held comes later, what sleeps is lost.
MODULE asleep_or_held
  VAR intnum tick;
  VAR num count;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer 0.1,tick;
    IDisable;
    WaitTime 0.35;
    TPWrite "held "\Num:=count;       ! -> held 0
    IEnable;
    TPWrite "served "\Num:=count;       ! -> served 3
    ISleep tick;
    WaitTime 0.5;
    TPWrite "asleep "\Num:=count;       ! -> asleep 3
    IWatch tick;
    WaitTime 0.15;
    TPWrite "awake "\Num:=count;       ! -> awake 4
    IDelete tick;
    ITimer 0.1,tick;
  ERROR
    TPWrite "unknown "\Bool:=ERRNO=ERR_UNKINO;       ! -> unknown TRUE
    TRYNEXT;
  ENDPROC

  TRAP on_tick
    Incr count;
  ENDTRAP
ENDMODULE
