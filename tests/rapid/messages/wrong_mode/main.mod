! RAPID Instructions, RMQReadWait: belongs to synchronous mode.
MODULE wrong_mode
  VAR rmqmessage message;
  PROC main()
    RMQReadWait message;  ! stops: RMQReadWait: the queue of this task is in interrupt mode
  ENDPROC
ENDMODULE
