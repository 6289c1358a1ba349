! RAPID Kernel, Procedure calls: arguments follow the name without parentheses.
MODULE procedures
  PROC main()
    plain;
    both 1,"two";
    both (1),("two");
    one (1)+(2);
    one -1;
    one TRUE\also:=4;                 ! error: T301
  ENDPROC

  PROC plain()
  ENDPROC

  PROC both(num a,string b)
  ENDPROC

  PROC one(num a\num also)
  ENDPROC
ENDMODULE
