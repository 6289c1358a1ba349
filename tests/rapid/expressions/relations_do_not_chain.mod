! RAPID Kernel, Expressions: a = b = c is none.
MODULE relations_do_not_chain
  VAR bool b;

  PROC main()
    b:=1=1=1;                     ! error: E101
    b:=(1=1)=TRUE;
  ENDPROC
ENDMODULE
