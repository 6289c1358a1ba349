! RAPID Kernel, CONNECT: the trap may be named by a string; brackets with no parameters are lenient.
MODULE late_connect
  VAR intnum tick;
  VAR intnum ticks{2};

  PROC main()
    CONNECT tick WITH %"on_"+"tick"%;
    CONNECT ticks{1} WITH on_other;
    ITimer\Single,1,tick;
    ITimer\Single,2,ticks{1};
    WaitTime 3;
    CONNECT tick WITH %"on_nothing"%;   ! stops: no trap routine is named "on_nothing" (ERR_REFUNKTRP)
  ENDPROC

  TRAP on_tick()
    TPWrite "tick";                     ! -> tick
  ENDTRAP

  LOCAL TRAP on_other
    TPWrite "other";                    ! -> other
  ENDTRAP
ENDMODULE
