MODULE example
  VAR socketdev server;
  VAR socketdev host;
  PROC main()
    SocketCreate server;
    SocketBind server,"127.0.0.1",1025;
    SocketListen server;
    SocketAccept server,host\Time:=2; ! found
  ENDPROC
ENDMODULE
