MODULE example
  PROC main()
    stack 3;
  ENDPROC
  PROC stack(num layers)
    IF layers>1 stack layers-1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PROC main()
    stack 3;
  ENDPROC
  PROC stack(num layers)
    IF layers>1 stack layers-1;       ! found
  ENDPROC
  FUNC num even(num n)
    IF n=0 RETURN 1;
    RETURN odd(n-1);                  ! found
  ENDFUNC
  FUNC num odd(num n)
    IF n=0 RETURN 0;
    RETURN even(n-1);                 ! found
  ENDFUNC
ENDMODULE
