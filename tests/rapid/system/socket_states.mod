! RAPID Instructions, SocketBind: states of a socket, and what is refused in each.
MODULE socket_states
  VAR socketdev server;
  VAR socketdev other;
  VAR socketdev client;

  PROC main()
    TPWrite ValToStr(SocketGetStatus(server)=SOCKET_CLOSED); ! -> TRUE
    SocketBind server,"192.168.125.1",1025;
    SocketCreate server;
    TPWrite ValToStr(SocketGetStatus(server)=SOCKET_CREATED); ! -> TRUE
    SocketCreate server;
    SocketListen server;
    SocketBind server,"192.168.125.1",1025;
    TPWrite ValToStr(SocketGetStatus(server)=SOCKET_BOUND); ! -> TRUE
    SocketBind server,"192.168.125.1",1026;
    SocketCreate other;
    SocketBind other,"192.168.125.1",1025;
    SocketListen server;
    TPWrite ValToStr(SocketGetStatus(server)=SOCKET_LISTENING); ! -> TRUE
    SocketAccept server,client\Time:=2;     ! warning: R115
    SocketSend client\Str:="hello";
    SocketReceive server\Str:=text\Time:=1;
    SocketClose other;
    SocketClose server;
    SocketClose server;
    SocketConnect other,"192.168.125.9",1025;
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_SOCK_CLOSED:
      TPWrite "closed";                     ! -> closed ! -> closed ! -> closed
    CASE ERR_SOCK_IS_CONN:
      TPWrite "is connected";               ! -> is connected
    CASE ERR_SOCK_IS_BOUND:
      TPWrite "is bound";                   ! -> is bound
    CASE ERR_SOCK_NOT_BOUND:
      TPWrite "not bound";                  ! -> not bound
    CASE ERR_SOCK_ADDR_INUSE:
      TPWrite "in use";                     ! -> in use
    CASE ERR_SOCK_TIMEOUT:
      TPWrite "time";                       ! -> time
    CASE ERR_SOCK_NOT_CONN:
      TPWrite "not connected";              ! -> not connected
    DEFAULT:
      TPWrite "other";
    ENDTEST
    TRYNEXT;
  ENDPROC

  VAR string text;
ENDMODULE
