! RAPID Instructions, RMQFindSlot: nobody finds the queue of a task that has none.
MODULE no_queue
  VAR rmqslot here;
  PROC main()
    RMQFindSlot here,"RMQ_T_ROB1";  ! stops: there is no message queue RMQ_T_ROB1 (ERR_RMQ_NAME)
  ENDPROC
ENDMODULE
