! RAPID Kernel, Expressions: one argument in parentheses is an expression, so this is legal.
MODULE in_parentheses
  PROC main()
    TPWrite ("a"+"b");                ! -> ab
    WaitTime(1);
    show(2);
  ENDPROC

  PROC show(num n)
    TPWrite ValToStr(n);              ! -> 2
  ENDPROC
ENDMODULE
