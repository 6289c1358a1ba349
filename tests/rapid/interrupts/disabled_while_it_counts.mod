! RAPID Instructions, IDisable: what comes meanwhile is served at IEnable, in order.
MODULE disabled_while_it_counts
  VAR intnum first;
  VAR intnum second;

  PROC main()
    CONNECT first WITH on_first;
    CONNECT second WITH on_second;
    IDisable;
    ITimer \Single,0.2,second;
    ITimer \Single,0.4,first;
    WaitTime 1;
    TPWrite "waited";                   ! -> waited
    IEnable;
    TPWrite "served";                   ! -> served
  ENDPROC

  TRAP on_first
    TPWrite "first";                    ! -> first
  ENDTRAP

  TRAP on_second
    TPWrite "second";                   ! -> second
  ENDTRAP
ENDMODULE
