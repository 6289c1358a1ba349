MODULE jumps
  VAR num n:=0;
  PROC main()
    begin:
    n:=n+1;
    IF n>3 GOTO ready;
    IF(n MOD 2)=1 THEN
      TPWrite ("odd "+ValToStr(n));
    ENDIF
    GOTO begin;
    ready:
    WaitTime(1);
    Outer;
    EXIT;
  ENDPROC
  PROC Outer()
    Middle;
  ERROR (ERR_DIVZERO,7)
    TPWrite "far away";
    TRYNEXT;
  ENDPROC
  PROC Middle()
    n:=n/(n-n);
  ENDPROC
ENDMODULE
