MODULE example
  FUNC num larger(num a,num b)
    IF a>b THEN
      RETURN a;
    ENDIF
  ENDFUNC ! found
ENDMODULE
! ---
MODULE example
  VAR num zero;

  FUNC num share(num whole)
    RETURN whole/zero;
  ERROR ! found
    TPWrite "no share";
  ENDFUNC
ENDMODULE
