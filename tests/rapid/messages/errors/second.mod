! RAPID Instructions, RMQGetMsgData: type and dimensions must be those of the message.
MODULE second
  VAR intnum came;
  VAR num number;
  VAR dnum long;
  VAR num pair{2};
  VAR num turns;
  PROC main()
    CONNECT came WITH take;
    IRMQMessage number,came;
    WaitTime 10;
  ENDPROC
  TRAP take
    VAR rmqmessage message;
    Incr turns;
    RMQGetMessage message;
    IF turns>1 RETURN;
    RMQGetMsgData message,long;
    RMQGetMsgData message,pair;
    RMQGetMessage message;
    WaitTime 3;
  ERROR
    TEST ERRNO
    CASE ERR_RMQ_VALUE:
      TPWrite "another type";        ! -> another type
    CASE ERR_RMQ_DIM:
      TPWrite "other dimensions";    ! -> other dimensions
    CASE ERR_RMQ_NOMSG:
      TPWrite "no message";          ! -> no message
    ENDTEST
    TRYNEXT;
  ENDTRAP
ENDMODULE
