! RAPID Functions, StrToVal: from text to value of any type, and what is none.
MODULE text_to_value
  PROC main()
    VAR num n:=1;
    VAR pos p;
    VAR bool ok;
    VAR bool b;
    VAR string s;
    VAR num a{2};
    VAR dnum d;
    ok:=StrToVal("3.85",n);
    TPWrite ValToStr(ok)+ValToStr(n);       ! -> TRUE3.85
    ok:=StrToVal("[600,500,225.3]",p);
    TPWrite ValToStr(ok)+ValToStr(p);       ! -> TRUE[600,500,225.3]
    ok:=StrToVal("abc",n);
    TPWrite ValToStr(ok)+ValToStr(n);       ! -> FALSE3.85
    ok:=StrToVal("TRUE",b);
    TPWrite ValToStr(ok)+ValToStr(b);       ! -> TRUETRUE
    ok:=StrToVal("""text""",s);
    TPWrite ValToStr(ok)+s;                 ! -> TRUEtext
    ok:=StrToVal("[1,2]",a);
    TPWrite ValToStr(ok)+ValToStr(a{2});    ! -> TRUE2
    ok:=StrToVal("[1,2,3]",a);
    TPWrite ValToStr(ok);                   ! -> FALSE
    ok:=StrToVal(" -1E3 ",n);
    TPWrite ValToStr(ok)+ValToStr(n);       ! -> TRUE-1000
    ok:=StrToVal("1E100",d);
    TPWrite ValToStr(ok);                   ! -> TRUE
    ok:=StrToVal("1E100",n);
    TPWrite ValToStr(ok);                   ! -> FALSE
    ok:=StrToVal("1+1",n);
    TPWrite ValToStr(ok);                   ! -> FALSE
    ok:=StrToVal("",n);
    TPWrite ValToStr(ok);                   ! -> FALSE
  ENDPROC
ENDMODULE
