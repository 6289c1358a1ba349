MODULE beginner
  VAR num i
  VAR num total:=0;
  PROC main()
    i = 1;
    WHILE i <= 10 DO
      IF i MOD 2 = 0 THEN
        total := total + i
      ELSEIF i = 5
        TPWrite "five;
      ELSE
        a[i] := i;
    ENDWHILE
    Stop
    report total;

  PROC report(num n)
    TPWrite "total " + NumToStr(n,0;
    IF n > 10 THNE
      Stop;
    ENDIF
  ENDPROC
ENDMODULE
