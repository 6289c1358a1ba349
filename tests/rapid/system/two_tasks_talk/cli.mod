! RAPID Instructions, SocketConnect: a client that takes a text in parts, and sends raw bytes.
MODULE cli
  VAR socketdev client;
  VAR string heard;
  VAR rawbytes raw;
  VAR num got;

  PROC main()
    FOR i FROM 1 TO 2 DO
      SocketCreate client;
      SocketConnect client,"192.168.125.1",1025;
      SocketSend client\Str:="Hello server "+NumToStr(i,0);
      SocketReceive client\Str:=heard\ReadNoOfBytes:=3\NoRecBytes:=got;
      TPWrite heard\Num:=got;
      ! -> ack3
      ! -> ack3
      TPWrite "left "\Num:=SocketPeek(client);
      ! -> left 9
      ! -> left 9
      ClearRawBytes raw;
      PackRawBytes 258,raw,1\IntX:=INT;
      PackRawBytes 3.5,raw,RawBytesLen(raw)+1\Float4;
      SocketSend client\RawData:=raw;
      WaitTime 1;
      SocketClose client;
    ENDFOR
    WaitTime 0.5;
    SocketCreate client;
    SocketConnect client,"192.168.125.1",1025\Time:=2;      ! warning: R112
    TPWrite "never";
  ERROR
    IF ERRNO=ERR_SOCK_TIMEOUT TPWrite "nobody listens";  ! -> nobody listens
  ENDPROC
ENDMODULE
