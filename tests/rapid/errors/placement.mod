! RAPID Kernel, Error recovery: RETRY, TRYNEXT and RAISE without a number belong in ERROR clauses.
MODULE placement
  PROC main()
    RETRY;                              ! error: F406
    TRYNEXT;                            ! error: F406
    RAISE;                              ! error: F406
    RAISE 5;                            ! warning: F401
  ERROR
    RAISE;
  UNDO
    RETRY;                              ! error: F406
  ENDPROC

  TRAP on_tick
    RAISE;                              ! error: F406
  ENDTRAP
ENDMODULE
