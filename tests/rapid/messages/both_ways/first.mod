! RAPID Instructions, RMQSendMessage and RMQSendWait: a message goes whole, an answer raises no interrupt.
MODULE first
  RECORD order
    num count;
    string part;
  ENDRECORD
  VAR rmqslot worker;
  VAR rmqmessage answer;
  VAR order wanted:=[2,"say ""so"""];
  VAR string words{2}:=["a","b"];
  VAR bool done;
  VAR intnum told;
  PROC main()
    CONNECT told WITH tell;
    IRMQMessage done,told;
    RMQFindSlot worker,"RMQ_T_ROB2";
    TPWrite RMQGetSlotName(worker);  ! -> RMQ_T_ROB2
    WaitTime 1;
    ! Arrays and records go whole.
    RMQSendMessage worker,words\UserDef:=7;
    RMQSendMessage worker,wanted;
    WaitTime 1;
    ! The answer takes half a second.
    RMQSendWait worker,wanted,answer,done\Timeout:=5;
    RMQGetMsgData answer,done;
    TPWrite "answered "\Bool:=done;  ! -> answered TRUE
    WaitTime 1;
  ENDPROC
  TRAP tell
    VAR rmqmessage heard;
    RMQGetMessage heard;
    RMQGetMsgData heard,done;
    TPWrite "told "\Bool:=done;  ! -> told FALSE
  ENDTRAP
ENDMODULE
