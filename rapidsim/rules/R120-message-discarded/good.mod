MODULE example
  VAR rmqslot here;
  VAR rmqmessage message;
  VAR intnum arrived;
  VAR num count:=3;
  PROC main()
    CONNECT arrived WITH take;
    IRMQMessage count,arrived;
    RMQFindSlot here,"RMQ_T_ROB1";
    RMQSendMessage here,count;
  ENDPROC
  TRAP take
    RMQGetMessage message;
    RMQGetMsgData message,count;
  ENDTRAP
ENDMODULE
