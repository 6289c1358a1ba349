! Field practice, RobotWare 6: a routine of the program may have a name that came later.
MODULE older_with_own_name
  PROC main()
    TPWrite ValToStr(Max(2,5));             ! -> 5
  ENDPROC

  FUNC num Max(num a,num b)
    IF a>b RETURN a;
    RETURN b;
  ENDFUNC
ENDMODULE
