! RAPID Kernel, Data type num: single precision, exact to 2 to the power of 23; dnum: double.
MODULE single_precision
  VAR num n:=16777216;
  VAR dnum d:=16777216;
  VAR num tenth:=0.1;
  VAR num sum;

  PROC main()
    n:=n+1;
    d:=d+1;
    TPWrite NumToStr(n,0);          ! -> 16777216
    TPWrite DnumToStr(d,0);         ! -> 16777217
    FOR i FROM 1 TO 10 DO
      sum:=sum+tenth;
    ENDFOR
    TPWrite ValToStr(sum=1);        ! -> FALSE
    TPWrite ValToStr(sum);          ! -> 1
    TPWrite ValToStr(tenth=0.1);    ! -> TRUE
  ENDPROC
ENDMODULE
