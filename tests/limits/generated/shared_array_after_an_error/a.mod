MODULE moduleA
  ! A module that may be loaded makes all persistents shared.
  VAR loadsession session;
  PROC main()
  ENDPROC
  PROC loads()
    StartLoad "part.mod",session;
  ENDPROC
ENDMODULE
