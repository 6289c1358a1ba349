! RAPID Kernel, Functions: have a type, stand in expressions, and may call themselves.
MODULE functions
  PROC main()
    TPWrite ValToStr(factorial(5));       ! -> 120
    TPWrite greeting("you");              ! -> hello you
    TPWrite ValToStr(shifted([1,2,3]));   ! -> [2,3,4]
    TPWrite ValToStr(is_even(3));         ! -> FALSE
  ENDPROC

  FUNC num factorial(num n)
    IF n<=1 RETURN 1;
    RETURN n*factorial(n-1);
  ENDFUNC

  LOCAL FUNC string greeting(string name)
    RETURN "hello "+name;
  ENDFUNC

  FUNC pos shifted(pos p)
    RETURN p+[1,1,1];
  ENDFUNC

  FUNC bool is_even(num n)
    RETURN n MOD 2=0;
  ENDFUNC
ENDMODULE
