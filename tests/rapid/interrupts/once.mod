! RAPID Instructions, ITimer: \Single orders one interrupt.
MODULE once
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer\Single,0.5,tick;
    WaitTime 3;
    TPWrite "end";                      ! -> end
  ENDPROC

  TRAP on_tick
    TPWrite "tick";                     ! -> tick
    RETURN;
    TPWrite "never";                    ! warning: F401
  ENDTRAP
ENDMODULE
