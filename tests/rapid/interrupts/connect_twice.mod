! RAPID Kernel, CONNECT: a connected variable is the error ERR_ALRDYCNT until IDelete.
MODULE connect_twice
  VAR intnum tick;

  PROC main()
    CONNECT tick WITH on_tick;
    IDelete tick;
    CONNECT tick WITH on_tick;
    CONNECT tick WITH on_tick;
    TPWrite "once";                     ! -> once
  ERROR
    IF ERRNO=ERR_ALRDYCNT TRYNEXT;
  ENDPROC

  TRAP on_tick
  ENDTRAP
ENDMODULE
