! RAPID Kernel, Alias types: the alias and its type are interchangeable.
MODULE aliases_interchange
  ALIAS num level;
  VAR level high_water:=3;
  VAR num n;

  PROC main()
    n:=high_water+1;
    high_water:=n;
    TPWrite ValToStr(twice(high_water)); ! -> 8
  ENDPROC

  FUNC level twice(num x)
    RETURN 2*x;
  ENDFUNC
ENDMODULE
