MODULE srv
  VAR socketdev letters;
  VAR rawbytes raw;
  VAR rawbytes answer;
  VAR string address;
  VAR num port;

  PROC main()
    SocketCreate letters\UDP;
    SocketBind letters,"192.168.125.1",1025;
    WHILE TRUE DO
      ClearRawBytes answer;
      SocketReceiveFrom letters\RawData:=raw,address,port\Time:=3;
      PackRawBytes "got ",answer,1\ASCII;
      CopyRawBytes raw,1,answer,5;
      SocketSendTo letters,address,port\RawData:=answer;
    ENDWHILE
  ERROR
    IF ERRNO=ERR_SOCK_TIMEOUT THEN
      SocketClose letters;
      RETURN;
    ENDIF
    RAISE;
  ENDPROC
ENDMODULE
