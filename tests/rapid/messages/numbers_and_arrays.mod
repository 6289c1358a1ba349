! RAPID Instructions, IRMQMessage: numbers, and arrays of them, have interrupts of their own.
MODULE numbers_and_arrays
  VAR rmqslot own;
  VAR rmqmessage message;
  VAR intnum came;
  VAR intnum many;
  VAR num number:=7;
  VAR num numbers{3}:=[1,2,3];
  VAR string words:="words";

  PROC main()
    RMQFindSlot own,"RMQ_T_ROB1";
    CONNECT came WITH take;
    IRMQMessage number,came;
    CONNECT many WITH take;
    IRMQMessage numbers,many;
    RMQSendMessage own,number\UserDef:=3;
    WaitTime 1;
    RMQSendMessage own,numbers;
    WaitTime 1;
    IDelete came;
    TPWrite "end";                                     ! -> end
  ENDPROC

  TRAP take
    VAR num user;
    VAR rmqheader header;
    RMQGetMessage message;
    RMQGetMsgHeader message\Header:=header\UserDef:=user;
    TPWrite ValToStr(INTNO=many)+" "+ValToStr(header)+" "+ValToStr(user);
    ! -> FALSE ["num",0,0,0,0] 3
    ! -> TRUE ["num",1,3,0,0] -1
    RMQGetMessage message;
  ERROR
    TPWrite "no more "\Bool:=ERRNO=ERR_RMQ_NOMSG;
    ! -> no more TRUE
    ! -> no more TRUE
    RETURN;
  ENDTRAP
ENDMODULE
