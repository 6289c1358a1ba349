! RAPID Instructions, SocketSendTo: which sockets send and take datagrams, and what they raise.
MODULE datagrams_errors
  VAR socketdev letters;
  VAR socketdev other;
  VAR socketdev stream;
  VAR string text:="";
  VAR string address:="";
  VAR num port;

  PROC main()
    SocketSendTo letters,"127.0.0.1",5000\Str:="x";
    SocketCreate letters\UDP;
    TPWrite ValToStr(SocketGetStatus(letters)=SOCKET_CREATED); ! -> TRUE
    SocketBind letters,"127.0.0.1",5000;
    TPWrite ValToStr(SocketGetStatus(letters)=SOCKET_BOUND);   ! -> TRUE
    SocketBind letters,"127.0.0.1",5001;
    SocketCreate other\UDP;
    SocketBind other,"127.0.0.1",5000;
    SocketSendTo other,"here",5000\Str:="x";
    SocketSendTo other,"127.0.0.1",70000\Str:="x";
    SocketReceiveFrom letters\Str:=text,address,port\Time:=0.5;
    SocketListen letters;
    SocketConnect letters,"127.0.0.1",5000;
    SocketSend letters\Str:="x";
    SocketCreate stream;
    SocketSendTo stream,"127.0.0.1",5000\Str:="x";
    ! A port that is given back can be taken again.
    SocketClose letters;
    SocketBind other,"127.0.0.1",5000;
    TPWrite ValToStr(SocketGetStatus(letters)=SOCKET_CLOSED);  ! -> TRUE
    ! A datagram that nobody takes is lost.
    SocketSendTo other,"192.168.125.9",5000\Str:="x";          ! warning: R104
    TPWrite text+address;                                      ! ->
  ERROR
    TPWrite named();
    ! -> closed
    ! -> is bound
    ! -> in use
    ! -> invalid
    ! -> invalid
    ! -> timeout
    ! -> unspecified
    ! -> unspecified
    ! -> not connected
    ! -> unspecified
    TRYNEXT;
  ENDPROC

  FUNC string named()
    TEST ERRNO
    CASE ERR_SOCK_CLOSED:
      RETURN "closed";
    CASE ERR_SOCK_IS_BOUND:
      RETURN "is bound";
    CASE ERR_SOCK_ADDR_INUSE:
      RETURN "in use";
    CASE ERR_SOCK_ADDR_INVALID:
      RETURN "invalid";
    CASE ERR_SOCK_TIMEOUT:
      RETURN "timeout";
    CASE ERR_SOCK_UNSPEC:
      RETURN "unspecified";
    CASE ERR_SOCK_NOT_CONN:
      RETURN "not connected";
    DEFAULT:
      RETURN "another";
    ENDTEST
  ENDFUNC
ENDMODULE
