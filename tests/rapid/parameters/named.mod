! RAPID Kernel, Argument lists: required arguments may carry their names.
MODULE named_arguments
  PROC main()
    show a:=1,b:=2;
    show 3,b:=4;
    TPWrite ValToStr(less(a:=5,b:=2));    ! -> 3
  ENDPROC

  PROC show(num a,num b)
    TPWrite ValToStr(a)+ValToStr(b);
    ! -> 12
    ! -> 34
  ENDPROC

  FUNC num less(num a,num b)
    RETURN a-b;
  ENDFUNC
ENDMODULE
