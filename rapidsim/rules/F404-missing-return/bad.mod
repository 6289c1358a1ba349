MODULE example
  FUNC num larger(num a,num b)
    IF a>b THEN
      RETURN a;
    ENDIF
  ENDFUNC ! found
ENDMODULE
