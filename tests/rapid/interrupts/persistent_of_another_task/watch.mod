! RAPID Overview, Program data: a persistent without a value takes it from the task that gives one.
MODULE watch
  PERS num counter;

  PROC main()
    WaitTime 1;
    counter:=1;
    WaitTime 1;
    counter:=1;
    counter:=2;
    counter:=3;
    WaitTime 100;
  ENDPROC
ENDMODULE
