MODULE example
  TASK PERS beaddata gun1:=[1,5,[0,0]];
  PROC main()
    TPWrite "no glue";
    IF FALSE gun1.pressure:=6;
  ENDPROC
ENDMODULE
