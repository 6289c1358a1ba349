! RAPID Overview, Interrupts: those that come while a trap runs wait, and are served in order.
MODULE queue_in_order
  VAR intnum slow;
  VAR intnum quick;
  VAR intnum last;

  PROC main()
    CONNECT slow WITH on_slow;
    CONNECT quick WITH on_quick;
    CONNECT last WITH on_last;
    ITimer \Single,0.2,slow;
    ITimer \Single,0.3,last;
    ITimer \Single,0.4,quick;
    WaitTime 3;
  ENDPROC

  TRAP on_slow
    TPWrite "slow begins";              ! -> slow begins
    WaitTime 1;
    TPWrite "slow ends";                ! -> slow ends
  ENDTRAP

  TRAP on_quick
    TPWrite "quick";                    ! -> quick
  ENDTRAP

  TRAP on_last
    TPWrite "last";                     ! -> last
  ENDTRAP
ENDMODULE
