! RAPID Kernel, Statements: what stands behind a jump is executed only from a label.
MODULE unreachable
  VAR num n;

  PROC main()
    IF n=1 THEN
      RETURN;
      n:=2;                             ! warning: F401
      n:=3;
    ENDIF
    IF n=0 THEN
      n:=1;
      GOTO over;
    ELSE
      EXIT;
    ENDIF
    n:=4;                               ! warning: F401
    over:
    forgiven;
    TPWrite ValToStr(n)+ValToStr(sign(n));  ! -> 21
    WHILE TRUE DO
      IF n=2 RETURN;
    ENDWHILE
    n:=5;                               ! warning: F401
  ENDPROC

  PROC forgiven()
    RAISE 7;
    n:=n+1;                             ! behind a RAISE that TRYNEXT answers
  ERROR
    TRYNEXT;
  ENDPROC

  FUNC num sign(num x)
    IF x<0 THEN
      RETURN -1;
    ELSE
      RETURN 1;
    ENDIF
    RETURN 0;                           ! for safety
  ENDFUNC
ENDMODULE
