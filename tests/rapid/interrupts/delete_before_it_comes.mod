! RAPID Instructions, IDelete: an interrupt that is deleted does not come any more.
MODULE delete_before_it_comes
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH ticks;
    ITimer 0.5,tick;
    WaitTime 1.2;
    IDelete tick;
    WaitTime 2;
    TPWrite "end";                      ! -> end
  ENDPROC

  TRAP ticks
    TPWrite "tick";
    ! -> tick
    ! -> tick
  ENDTRAP
ENDMODULE
