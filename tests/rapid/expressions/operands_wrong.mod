! RAPID Kernel, Operators: each is made for certain types.
MODULE operands_wrong
  VAR num n;
  VAR bool b;
  VAR pos p;
  VAR orient q;
  VAR string s;

  PROC main()
    b:=n AND b;                   ! error: T313
    b:=NOT n;                     ! error: T313
    b:=s<"a";                     ! error: T313
    p:=2/p;                       ! error: T313
    q:=q+q;                       ! error: T313
    n:=b+1;                       ! error: T313
    s:=-s;                        ! error: T313
    b:=p>p;                       ! error: T313
    b:=p=1;                       ! error: T313
  ENDPROC
ENDMODULE
