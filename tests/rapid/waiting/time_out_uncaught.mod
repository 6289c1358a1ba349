! RAPID Instructions, WaitUntil: nobody handles the time-out, so it stops the program.
MODULE time_out_uncaught
  VAR bool ready;

  PROC main()
    WaitUntil ready\MaxTime:=2;         ! stops: WaitUntil waited 2 s in vain (ERR_WAIT_MAXTIME)
  ENDPROC
ENDMODULE
