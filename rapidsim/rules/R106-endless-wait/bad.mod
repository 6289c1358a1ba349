MODULE example
  PROC main()
    Set doGrip;
    WaitDI diGripped,1; ! found
  ENDPROC
ENDMODULE
