MODULE example
  VAR robtarget home;
  PROC main()
    home.pos.z:=100; ! found
  ENDPROC
ENDMODULE
