! RAPID Instructions, SocketBind: a port is taken as soon as a socket is bound to it, and until it closes.
MODULE port_in_use
  VAR socketdev first;
  VAR socketdev second;

  PROC main()
    SocketCreate first;
    SocketBind first,"192.168.125.1",1025;
    SocketCreate second;
    SocketBind second,"192.168.125.1",1025;
    TPWrite ValToStr(SocketGetStatus(second)=SOCKET_CREATED); ! -> TRUE
    SocketBind second,"192.168.125.1",1026;
    TPWrite ValToStr(SocketGetStatus(second)=SOCKET_BOUND); ! -> TRUE
    SocketClose first;
    SocketClose second;
    SocketCreate second;
    SocketBind second,"192.168.125.1",1025;
    SocketListen second;
    TPWrite ValToStr(SocketGetStatus(second)=SOCKET_LISTENING); ! -> TRUE
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SOCK_ADDR_INUSE); ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
