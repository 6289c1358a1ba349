! RAPID Instructions, SocketReceive: a socket that is closed receives nothing, whoever is out there.
MODULE socket_closed_uncaught
  VAR socketdev s;
  VAR string heard;

  PROC main()
    SocketCreate s;
    SocketBind s,"192.168.125.1",1025;
    SocketClose s;
    SocketReceive s\Str:=heard\Time:=1;  ! stops: the socket is closed; SocketCreate makes it (ERR_SOCK_CLOSED)
  ENDPROC
ENDMODULE
