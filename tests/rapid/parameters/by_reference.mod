! RAPID Kernel, Parameters: INOUT, VAR and PERS refer to the caller's data.
MODULE by_reference
  VAR num n:=1;
  VAR num list{3}:=[1,2,3];
  VAR pos p:=[1,2,3];
  PERS num kept:=1;

  PROC main()
    double n;
    double kept;
    double list{2};
    double p.z;
    TPWrite ValToStr(n)+ValToStr(kept)+ValToStr(list)+ValToStr(p); ! -> 22[1,4,3][1,2,6]
    add_to n;
    store kept;
    TPWrite ValToStr(n)+ValToStr(kept);     ! -> 312
    swap list{1},list{3};
    TPWrite ValToStr(list);                 ! -> [3,4,1]
  ENDPROC

  PROC double(INOUT num x)
    x:=2*x;
  ENDPROC

  PROC add_to(VAR num x)
    x:=x+1;
  ENDPROC

  PROC store(PERS num x)
    x:=x+10;
  ENDPROC

  PROC swap(INOUT num a,INOUT num b)
    VAR num between;
    between:=a;
    a:=b;
    b:=between;
  ENDPROC
ENDMODULE
