! RAPID Instructions, RMQSendMessage and others: each error of the message queues.
MODULE first
  VAR rmqslot other;
  VAR rmqslot never;
  VAR rmqmessage answer;
  VAR num number:=5;
  VAR string words{6};
  PROC main()
    VAR num sent;
    RMQFindSlot other,"rmq_t_rob2";      ! the letters count
    RMQSendMessage never,number;
    TPWrite RMQGetSlotName(never);
    RMQGetMsgData answer,number;
    FOR i FROM 1 TO 6 DO
      words{i}:="1234567890123456789012345678901234567890123456789012345678901234567890";
    ENDFOR
    RMQFindSlot other,"RMQ_T_ROB2";
    WaitTime 1;
    RMQSendMessage other,words;
    RMQSendWait other,number,answer,number\Timeout:=0.5;
    ! The other task is in its trap: two messages wait, the third is one too many.
    WHILE sent<3 DO
      Incr sent;
      RMQSendMessage other,number;
    ENDWHILE
  ERROR
    TEST ERRNO
    CASE ERR_RMQ_NAME:
      TPWrite "name";     ! -> name
    CASE ERR_RMQ_INVALID:
      TPWrite "invalid";
      ! -> invalid
      ! -> invalid
    CASE ERR_RMQ_INVMSG:
      TPWrite "no message in it";   ! -> no message in it
    CASE ERR_RMQ_MSGSIZE:
      TPWrite "too long"; ! -> too long
    CASE ERR_RMQ_TIMEOUT:
      TPWrite "late";     ! -> late
    CASE ERR_RMQ_FULL:
      TPWrite "full";     ! -> full
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
