! RAPID Instructions, SocketReceiveFrom: peers of the station file that answer, or send first.
MODULE letters_of_scripts
  VAR socketdev letters;
  VAR string text;
  VAR string address;
  VAR num port;
  VAR clock timer;

  PROC main()
    ClkStart timer;
    SocketCreate letters\UDP;
    SocketSendTo letters,"192.168.125.9",5000\Str:="where?";
    SocketReceiveFrom letters\Str:=text,address,port;
    TPWrite text+" "+address+" "+ValToStr(port); ! -> 12.5 192.168.125.9 5000
    TPWrite ValToStr(Abs(ClkRead(timer)-0.2)<0.001); ! -> TRUE
    ! What it does not expect has no answer.
    SocketSendTo letters,address,port\Str:="where";
    SocketReceiveFrom letters\Str:=text,address,port\Time:=1;
    SocketClose letters;
    listen;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_TIMEOUT);  ! -> TRUE
    TRYNEXT;
  ENDPROC

  PROC listen()
    SocketCreate letters\UDP;
    SocketBind letters,"0.0.0.0",6000;
    ClkReset timer;
    ClkStart timer;
    SocketReceiveFrom letters\Str:=text,address,port;
    TPWrite text+" "+ValToStr(Abs(ClkRead(timer)-1)<0.001); ! -> one TRUE
    SocketReceiveFrom letters\Str:=text,address,port;
    TPWrite text+" "+ValToStr(Abs(ClkRead(timer)-1.5)<0.001); ! -> two TRUE
    ! An answer goes to where the datagram came from.
    SocketSendTo letters,address,port\Str:="thanks";
    SocketReceiveFrom letters\Str:=text,address,port;
    TPWrite text;                              ! -> bye
    SocketClose letters;
  ENDPROC
ENDMODULE
