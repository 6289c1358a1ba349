! RAPID Instructions, RMQGetMessage: elsewhere than in a trap a controller stops.
MODULE get_outside_a_trap
  VAR rmqmessage message;
  PROC main()
    RMQGetMessage message;  ! stops: RMQGetMessage can be used only in a trap
  ERROR
    TPWrite "not asked";
    TRYNEXT;
  ENDPROC
ENDMODULE
