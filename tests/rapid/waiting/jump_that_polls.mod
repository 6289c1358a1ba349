! Field practice, Polling: a GOTO back to a label polls like a loop.
MODULE jump_that_polls
  VAR intnum tick;
  VAR bool seen;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer \Single,25,tick;
    again:
    IF NOT seen GOTO again;
    TPWrite "seen";                     ! -> seen
  ENDPROC

  TRAP on_tick
    seen:=TRUE;
  ENDTRAP
ENDMODULE
