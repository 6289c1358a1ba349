MODULE example
  VAR num speed;
  PROC main()
    speed 100; ! found
  ENDPROC
ENDMODULE
