MODULE example
  VAR socketdev camera;
  PROC main()
    SocketCreate camera;
    SocketConnect camera,"192.168.125.5",1025; ! found
  ENDPROC
ENDMODULE
