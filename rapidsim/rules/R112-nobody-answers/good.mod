MODULE example
  VAR socketdev camera;
  PROC main()
    SocketCreate camera;
  ENDPROC
ENDMODULE
