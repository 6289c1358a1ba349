! RAPID Instructions, RMQReadWait: takes them in turn, waiting so long as it is told.
MODULE second
  VAR rmqmessage message;
  VAR rmqheader header;
  VAR num numbers{3};
  VAR string text;
  VAR num id;
  PROC main()
    RMQReadWait message;
    RMQGetMsgHeader message\Header:=header\UserDef:=id;
    TPWrite ValToStr(header)\Num:=id;  ! -> ["num",1,3,0,0]-1
    RMQGetMsgData message,numbers;
    TPWrite ValToStr(numbers);  ! -> [1,2,3]
    RMQReadWait message\TimeOut:=0;
    RMQGetMsgHeader message\UserDef:=id;
    RMQGetMsgData message,text;
    TPWrite text\Num:=id;  ! -> x0
    ! Nothing there: no wait at all, then a second in vain.
    RMQReadWait message\TimeOut:=0;
    RMQReadWait message\TimeOut:=1;
    WaitUntil CTime()="00:00:03";
    WaitTime 0.1;
    RMQEmptyQueue;
    RMQReadWait message\TimeOut:=WAIT_MAX;
    RMQGetMsgHeader message\Header:=header;
    TPWrite header.datatype;  ! -> num
    RMQReadWait message\TimeOut:=WAIT_MAX;  ! stops: `RMQReadWait` waits for a message, and none is sent
  ERROR
    IF ERRNO=ERR_RMQ_TIMEOUT THEN
      TPWrite "nothing";
      ! -> nothing
      ! -> nothing
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
