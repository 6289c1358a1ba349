! RAPID Instructions, IRMQMessage: a message raises the interrupt of its type; RMQGetMsgHeader says who sent it.
MODULE second
  ! The same record, declared again: the messages fit.
  RECORD order
    num count;
    string part;
  ENDRECORD
  VAR intnum on_words;
  VAR intnum on_order;
  VAR order wanted;
  VAR string words{2};
  VAR rmqslot asker;
  VAR num id;
  PROC main()
    CONNECT on_words WITH say;
    IRMQMessage words,on_words;
    CONNECT on_order WITH work;
    IRMQMessage wanted,on_order;
    WaitTime 10;
  ENDPROC
  TRAP say
    VAR rmqmessage heard;
    VAR rmqheader header;
    RMQGetMessage heard;
    RMQGetMsgHeader heard\Header:=header\SenderId:=asker\UserDef:=id;
    TPWrite ValToStr(header);    ! -> ["string",1,2,0,0]
    TPWrite RMQGetSlotName(asker)\Num:=id;  ! -> RMQ_T_ROB17
    RMQGetMsgData heard,words;
    TPWrite words{1}+words{2};   ! -> ab
  ENDTRAP
  TRAP work
    VAR rmqmessage heard;
    VAR bool done;
    RMQGetMessage heard;
    RMQGetMsgHeader heard\SenderId:=asker\UserDef:=id;
    RMQGetMsgData heard,wanted;
    TPWrite wanted.part\Num:=id;
    ! -> say "so"-1
    ! -> say "so"-1
    IF wanted.count=2 AND ClkRead(since)=0 THEN
      RMQSendMessage asker,done;
      ClkStart since;
      WaitTime 0.1;
    ELSE
      WaitTime 0.5;
      done:=TRUE;
      RMQSendMessage asker,done;
    ENDIF
  ENDTRAP
  VAR clock since;
ENDMODULE
