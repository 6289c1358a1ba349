! Field practice, Operators: written as in C, read as in RAPID.
MODULE signs_and_not
  VAR bool done;
  VAR num n:=3;

  PROC main()
    WHILE NOT done AND n<5 DO             ! NOT (done AND n<5), which lasts longer than meant
      n:=n+1;
      IF n=9 GOTO enough;
    ENDWHILE
    enough:
    TPWrite ValToStr(n);                  ! -> 9
    n:=n*-2;                              ! note: E146
    TPWrite ValToStr(+n);                 ! -> -18
  ENDPROC
ENDMODULE
