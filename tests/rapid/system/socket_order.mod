! RAPID Instructions, SocketBind, SocketListen and SocketConnect: in their order, with addresses that are some.
MODULE socket_order
  VAR socketdev s;
  VAR string heard;

  PROC main()
    SocketListen s;                                ! not created yet
    SocketCreate s;
    SocketListen s;                                ! without a port
    SocketBind s,"10.0.0.300",1025;
    SocketBind s,"192.168.125.1",1025;
    SocketBind s,"192.168.125.1",1026;             ! it has one
    SocketReceive s\Str:=heard\Time:=1;
    SocketListen s;
    SocketConnect s,"192.168.125.1",1025;          ! it listens
    SocketClose s;
    SocketClose s;
    TPWrite "closed "\Bool:=SocketGetStatus(s)=SOCKET_CLOSED;   ! -> closed TRUE
  ERROR
    TEST ERRNO
    CASE ERR_SOCK_CLOSED:
      TPWrite "closed";          ! -> closed
    CASE ERR_SOCK_NOT_BOUND:
      TPWrite "not bound";       ! -> not bound
    CASE ERR_SOCK_ADDR_INVALID:
      TPWrite "no address";      ! -> no address
    CASE ERR_SOCK_IS_BOUND:
      TPWrite "bound";           ! -> bound
    CASE ERR_SOCK_NOT_CONN:
      TPWrite "not connected";   ! -> not connected
    CASE ERR_SOCK_UNSPEC:
      TPWrite "not possible";    ! -> not possible
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
