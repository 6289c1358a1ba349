MODULE example
  PROC main()
    SoftAct 3,20; ! found
    TPWrite "soft";
  ENDPROC
ENDMODULE
