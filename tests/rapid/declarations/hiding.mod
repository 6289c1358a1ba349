! RAPID Kernel, Scope rules: the nearest declaration hides the others.
MODULE hiding
  VAR num n:=1;
  LOCAL CONST num reg1:=100;

  PROC main()
    VAR num n:=2;
    TPWrite ValToStr(n);            ! -> 2
    TPWrite ValToStr(reg1);         ! -> 100
    parameter 3;
    counter;
  ENDPROC

  PROC parameter(num n)
    TPWrite ValToStr(n);            ! -> 3
  ENDPROC

  PROC counter()
    FOR n FROM 4 TO 4 DO
      TPWrite ValToStr(n);          ! -> 4
    ENDFOR
    TPWrite ValToStr(n);            ! -> 1
  ENDPROC
ENDMODULE
