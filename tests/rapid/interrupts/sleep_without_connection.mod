! RAPID Instructions, ISleep: an interrupt that is connected to nothing is ERR_UNKINO.
MODULE sleep_without_connection
  VAR intnum tick;

  PROC main()
    ISleep tick;
  ERROR
    TPWrite "unknown "\Bool:=ERRNO=ERR_UNKINO;   ! -> unknown TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
