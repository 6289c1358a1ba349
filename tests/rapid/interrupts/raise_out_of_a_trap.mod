! RAPID Instructions, RAISE: from a trap an error jumps to the clause that lists its number.
MODULE raise_out_of_a_trap
  VAR errnum ERR_DROP:=-1;
  VAR intnum dropped;
  VAR num cycles;

  PROC main()
    BookErrNo ERR_DROP;
    CONNECT dropped WITH on_drop;
    cycle;
    TPWrite "cycles "\Num:=cycles;      ! -> cycles 2
  ENDPROC

  PROC cycle()
    Incr cycles;
    handle_part;
    TPWrite "cycle ended";              ! -> cycle ended
  ERROR (ERR_DROP)
    TPWrite "part lost";                ! -> part lost
    cycles:=cycles+1;
    RETRY;
  ENDPROC

  PROC handle_part()
    IF cycles=1 ITimer \Single,0.3,dropped;
    WaitTime 1;
    TPWrite "part there";               ! -> part there
  ERROR
    TPWrite "never, it lists nothing";
    TRYNEXT;
  ENDPROC

  TRAP on_drop
    RAISE ERR_DROP;
  ERROR
    RAISE;
  ENDTRAP
ENDMODULE
