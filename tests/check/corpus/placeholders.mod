MODULE placeholders
  VAR num n;
  PROC main()
    n:=1;
    <SMT>
    WaitTime n;
  ENDPROC
ENDMODULE
