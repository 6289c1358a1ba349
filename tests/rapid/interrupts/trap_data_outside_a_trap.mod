! RAPID Instructions, GetTrapData: what made a trap run is known in the trap only.
MODULE trap_data_outside_a_trap
  VAR trapdata why;

  PROC main()
    GetTrapData why;                    ! stops: GetTrapData can be used in a trap only
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
ENDMODULE
