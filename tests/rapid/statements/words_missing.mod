! RAPID Kernel, WHILE and IF: DO and THEN belong to them.
MODULE words_missing
  VAR num n;

  PROC main()
    WHILE n<3                         ! error: E142
      Incr n;
    ENDWHILE
    IF n=1 THEN
      n:=2;
    ELSEIF n=2                        ! error: E142
      n:=3;
    ENDIF
  ENDPROC
ENDMODULE
