MODULE example
  VAR rmqslot here;
  VAR num count:=3;
  PROC main()
    RMQFindSlot here,"RMQ_T_ROB1";
    RMQSendMessage here,count; ! found
  ENDPROC
ENDMODULE
