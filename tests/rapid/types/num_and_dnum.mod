! RAPID Kernel, Type equality: num and dnum never mix; literals are what the place needs.
MODULE num_and_dnum
  VAR num n:=2;
  VAR dnum d:=3;

  PROC main()
    d:=2*d+1;
    n:=n+1;
    d:=n;                           ! error: T301
    n:=d;                           ! error: T301
    n:=n+d;                         ! error: T313
    d:=NumToDnum(n);
    n:=DnumToNum(d);
  ENDPROC
ENDMODULE
