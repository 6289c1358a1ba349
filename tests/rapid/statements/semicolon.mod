! RAPID Kernel, Statements: each ends in a semicolon.
MODULE semicolon
  VAR num n;

  PROC main()
    n:=1                              ! error: E103
    TPWrite "one"                     ! error: E103
    n:=2;
  ENDPROC
ENDMODULE
