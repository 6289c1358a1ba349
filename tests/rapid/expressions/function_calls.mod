! RAPID Kernel, Function calls: parentheses always; results nest.
MODULE function_calls
  PROC main()
    TPWrite ValToStr(Abs(-3)+largest(2,largest(5,4))); ! -> 8
    TPWrite ValToStr(answer());                        ! -> 42
    TPWrite ValToStr(Round(2.567\Dec:=1));             ! -> 2.6
  ENDPROC

  FUNC num largest(num a,num b)
    IF a>b RETURN a;
    RETURN b;
  ENDFUNC

  FUNC num answer()
    RETURN 42;
  ENDFUNC
ENDMODULE
