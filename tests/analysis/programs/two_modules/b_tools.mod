MODULE b_tools
  CONST num limit:=10;
  LOCAL VAR num own:=3;
  LOCAL VAR num private:=4;
  VAR bool shared;                      ! error: N202
  PROC helper(num x)
    own:=private+x;
    secret;
  ENDPROC
  LOCAL PROC secret()
  ENDPROC
  PROC MAIN()                           ! error: N202
  ENDPROC
ENDMODULE
