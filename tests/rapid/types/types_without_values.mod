! RAPID Kernel, Non-value types: a clock is passed around, never assigned or compared.
MODULE without_values
  VAR clock watch;
  VAR clock other;
  VAR clock started:=0;           ! error: T318

  PROC main()
    ClkReset watch;
    watch:=other;                 ! error: T318
    IF watch=other Stop;          ! error: T318
    time watch;
  ENDPROC

  PROC time(clock timer)          ! error: T320
  ENDPROC

  PROC right(VAR clock timer)
    ClkStart timer;
  ENDPROC
ENDMODULE
