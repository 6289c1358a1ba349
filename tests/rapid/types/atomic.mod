! RAPID Kernel, Data types: num, dnum, bool and string.
MODULE atomic
  VAR num n:=1.5;
  VAR dnum d:=4294967295;
  VAR bool b:=TRUE;
  VAR string s:="text";

  PROC main()
    TPWrite ValToStr(n);            ! -> 1.5
    TPWrite ValToStr(d);            ! -> 4294967295
    TPWrite ValToStr(b);            ! -> TRUE
    TPWrite ValToStr(s);            ! -> "text"
  ENDPROC
ENDMODULE
