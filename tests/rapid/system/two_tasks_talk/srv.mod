! RAPID Instructions, SocketAccept: a server in one task answers its clients one after the other.
MODULE srv
  VAR socketdev server;
  VAR socketdev client;
  VAR string heard;
  VAR rawbytes raw;
  VAR num number;
  VAR num served;

  PROC main()
    SocketCreate server;
    SocketBind server,"192.168.125.1",1025;
    SocketListen server;
    WHILE served<2 DO
      SocketAccept server,client\Time:=WAIT_MAX;
      Incr served;
      SocketReceive client\Str:=heard;
      TPWrite "heard "+heard;
      ! -> heard Hello server 1
      ! -> heard Hello server 2
      SocketSend client\Str:="acknowledged";
      SocketReceive client\RawData:=raw\ReadNoOfBytes:=6;
      UnpackRawBytes raw,3,number\Float4;
      TPWrite "number "\Num:=number;
      ! -> number 3.5
      ! -> number 3.5
      SocketReceive client\Str:=heard;
      SocketClose client;
    ENDWHILE
    SocketClose server;
  ERROR
    IF ERRNO=ERR_SOCK_CLOSED THEN
      TPWrite "client has gone";
      ! -> client has gone
      ! -> client has gone
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
