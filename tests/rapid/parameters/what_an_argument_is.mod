! RAPID Functions, IsPers: what an argument is; Type, Dim, Present.
MODULE what_an_argument_is
  PERS num kept:=1;
  VAR num gone:=2;
  ALIAS num level;
  VAR level high:=3;
  RECORD box
    num width;
    level height;
  ENDRECORD

  PROC main()
    VAR box b;
    VAR num a{2,3};
    ask kept;
    ask gone;
    TPWrite Type(high)+" "+Type(high\BaseName); ! -> level num
    TPWrite Type(b);                        ! -> box
    TPWrite Type(b.height)+Type(a);         ! -> levelnum
    TPWrite ValToStr(Dim(a,1))+ValToStr(Dim(a,2)); ! -> 23
  ENDPROC

  PROC ask(INOUT num n)
    TPWrite ValToStr(IsPers(n))+ValToStr(IsVar(n))+ArgName(n); ! -> TRUEFALSEkept ! -> FALSETRUEgone
  ENDPROC
ENDMODULE
