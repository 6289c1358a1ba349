MODULE example
  TASK PERS beaddata gun1:=[1,5,[0,0]];
  PROC main()
    TPWrite "glue";
    gun1.pressure:=6; ! found
  ENDPROC
ENDMODULE
