! RAPID Instructions, RMQSendMessage: a task may write to itself; what is taken must be of its type.
MODULE own_queue
  RECORD part
    num weight;
    string name;
  ENDRECORD
  VAR rmqslot own;
  VAR rmqmessage message;
  VAR part sent:=[3,"bolt"];
  VAR part taken;
  VAR num pair{2}:=[1,2];
  VAR num other{3};
  VAR rmqheader header;
  VAR num user;

  PROC main()
    RMQFindSlot own,"RMQ_T_ROB1";
    RMQSendMessage own,sent;
    RMQSendMessage own,pair\UserDef:=7;
    RMQReadWait message;          ! warning: R104
    RMQGetMsgData message,taken;
    TPWrite taken.name\Num:=taken.weight;              ! -> bolt3
    RMQReadWait message;
    RMQGetMsgHeader message\Header:=header\UserDef:=user;
    TPWrite ValToStr(header)+" "\Num:=user;            ! -> ["num",1,2,0,0] 7
    RMQGetMsgData message,taken;
    RMQGetMsgData message,other;
    RMQSendMessage own,pair;
    RMQEmptyQueue;
    RMQReadWait message\TimeOut:=2;
  ERROR
    TEST ERRNO
    CASE ERR_RMQ_VALUE:
      TPWrite "another type";                          ! -> another type
    CASE ERR_RMQ_DIM:
      TPWrite "other dimensions";                      ! -> other dimensions
    CASE ERR_RMQ_TIMEOUT:
      TPWrite "nothing came";                          ! -> nothing came
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
