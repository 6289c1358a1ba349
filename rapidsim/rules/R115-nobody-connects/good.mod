MODULE example
  VAR socketdev server;
  PROC main()
    SocketCreate server;
    SocketBind server,"127.0.0.1",1025;
    SocketListen server;
  ENDPROC
ENDMODULE
