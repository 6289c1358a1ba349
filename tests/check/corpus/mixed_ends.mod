MODULE mixed_ends
  VAR num n;
  PROC main()    n:=1;
    WaitTime n;
  ENDPROC
ENDMODULE