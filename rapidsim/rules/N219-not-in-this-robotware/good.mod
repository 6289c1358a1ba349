MODULE example
  FUNC num Max(num a,num b)
    IF a>b RETURN a;
    RETURN b;
  ENDFUNC
  PROC main()
    TPWrite ValToStr(Max(1,2));
  ENDPROC
ENDMODULE
