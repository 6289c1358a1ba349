! RAPID Kernel, Expressions: operands and arguments are evaluated from left to right.
MODULE order_of_evaluation
  VAR num count;
  VAR num list{3};

  PROC main()
    show next(),next(),next();
    TPWrite ValToStr(next()*100+next()*10+next());  ! -> 456
    list:=[next(),next(),next()];
    TPWrite ValToStr(list);                         ! -> [7,8,9]
  ENDPROC

  FUNC num next()
    count:=count+1;
    RETURN count;
  ENDFUNC

  PROC show(num a,num b,num c)
    TPWrite ValToStr(a)+ValToStr(b)+ValToStr(c);    ! -> 123
  ENDPROC
ENDMODULE
