! RAPID Instructions, RMQSendMessage: in synchronous mode messages wait in the order they came.
MODULE first
  VAR rmqslot other;
  CONST num three{3}:=[1,2,3];
  PERS string name:="x";
  VAR num nothing;
  PROC main()
    RMQFindSlot other,"RMQ_T_ROB2";
    RMQSendMessage other,three;
    RMQSendMessage other,name\UserDef:=0;
    WaitTime 3;
    RMQSendMessage other,name;
    RMQSendMessage other,name;
    WaitTime 1;
    RMQSendMessage other,nothing;
  ENDPROC
ENDMODULE
