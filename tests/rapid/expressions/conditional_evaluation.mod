! Field practice, AND and OR: the right operand is evaluated only where it decides.
MODULE conditional_evaluation
  PROC main()
    ask 0;
    ask 1\limit:=3;
    IF FALSE AND says("never") TPWrite "never";
    IF TRUE OR says("never") TPWrite "enough";      ! -> enough
    IF FALSE XOR says("asked") TPWrite "both";      ! -> both
  ENDPROC

  PROC ask(num n\num limit)
    IF Present(limit) AND limit>2 TPWrite "limit above 2 in call "\Num:=n;  ! -> limit above 2 in call 1
  ENDPROC

  FUNC bool says(string text)
    TPWrite text;                                   ! -> asked
    RETURN TRUE;
  ENDFUNC
ENDMODULE
