! RAPID Kernel, expressions: arrays of one type and size compare element by element.
MODULE arrays_compared
  VAR num a{3}:=[1,2,3];
  VAR num b{3}:=[1,2,3];
  CONST pos p{2}:=[[1,2,3],[4,5,6]];
  VAR pos q{2};

  PROC main()
    TPWrite ValToStr(a=b);                  ! -> TRUE
    b{2}:=5;
    TPWrite ValToStr(a=b);                  ! -> FALSE
    TPWrite ValToStr(a<>b);                 ! -> TRUE
    q:=p;
    TPWrite ValToStr(p=q);                  ! -> TRUE
    TPWrite ValToStr(same(a,b));            ! -> FALSE
  ENDPROC

  FUNC bool same(num x{*},num y{*})
    RETURN x=y;
  ENDFUNC
ENDMODULE
