! Nine million targets would take 4 GB: refused by its declaration.
MODULE array_of_nine_million_targets
  VAR robtarget a{1000,1000,9};
  PROC main()
    a{1,1,1}.trans.x:=5;
  ENDPROC
ENDMODULE
