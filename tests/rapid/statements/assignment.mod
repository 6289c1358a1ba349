! RAPID Kernel, Assignment: target := value; a lone semicolon is a statement too.
MODULE assignment
  VAR num n;
  VAR pos p;
  VAR num list{2};

  PROC main()
    n:=1;
    n:=n+1;;
    p.y:=n;
    list{n}:=p.y+1;
    ;
    TPWrite ValToStr(n)+ValToStr(p)+ValToStr(list);   ! -> 2[0,2,0][0,3]
  ENDPROC
ENDMODULE
