! RAPID Instructions, SocketSendTo: two tasks of a controller send each other datagrams.
MODULE cli
  VAR socketdev letters;
  VAR string text;
  VAR string address;
  VAR num port;
  VAR num count;
  VAR byte bytes{4};
  VAR rawbytes raw;

  PROC main()
    WaitTime 0.1;
    SocketCreate letters\UDP;
    ! A socket that SocketBind gave no port gets one with its first datagram.
    SocketSendTo letters,"127.0.0.1",1025\Str:="first";
    SocketReceiveFrom letters\Str:=text\NoRecBytes:=count,address,port\Time:=2;
    TPWrite text+" "+ValToStr(count)+" "+address+" "+ValToStr(port); ! -> got first 9 192.168.125.1 1025
    ! Each datagram is read as a whole, in order, also by the address that the other is bound to.
    SocketSendTo letters,"192.168.125.1",1025\Str:="second"\NoOfBytes:=3;
    SocketSendTo letters,"192.168.125.1",1025\Str:="third";
    SocketReceiveFrom letters\Str:=text,address,port;
    TPWrite text;                              ! -> got sec
    ! What does not fit is lost.
    SocketReceiveFrom letters\Data:=bytes\NoRecBytes:=count,address,port;
    TPWrite ValToStr(count)+" "+ValToStr(bytes{1}); ! -> 4 103
    PackRawBytes 7,raw,1\IntX:=DINT;
    SocketSendTo letters,"127.0.0.1",1025\RawData:=raw;
    SocketReceiveFrom letters\RawData:=raw,address,port;
    TPWrite ValToStr(RawBytesLen(raw));        ! -> 8
    SocketReceiveFrom letters\Str:=text,address,port\Time:=1;
    TPWrite "never";
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_TIMEOUT);  ! -> TRUE
    SocketClose letters;
    RETURN;
  ENDPROC
ENDMODULE
