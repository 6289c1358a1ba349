! RAPID Kernel, Module declarations: between the items of a module stand only items.
MODULE stray_text
  VAR num n;
  VAR num 2nd;                          ! error: E114
  n:=1;                                 ! error: E123
  CONST := 5;                           ! error: E101

  PROC main()
  ENDPROC
ENDMODULE
